#pragma once

#include "place/match/cost_matrix.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// How the rows of a cost matrix are made comparable before sequences are searched.
enum class Enhancement {
  kNone,         ///< costs as they are
  kLocal,        ///< SeqSLAM's: each cost against its neighbours along the reference
  kStandardise,  ///< each query over all references, then each reference over all queries, to mean 0 and
                 ///< deviation 1
};

/// Settings of `enhance_contrast`.
struct ContrastEnhancementOptions {
  Enhancement method = Enhancement::kStandardise;
  int window = 10;  ///< keyframes, `kLocal`: neighbours up to window / 2 on either side (SeqSLAM: R = 10)
  /// `kStandardise`: a reference's mean and variance over few queries say little of it, so they are drawn
  /// to 0 and 1, which rows leave it with, as if so many more queries had been seen: with w = queries /
  /// (queries + prior_queries), (x - w mean) / sqrt(w variance + 1 - w). 0 takes them as they are.
  double prior_queries = 0;
};

/// Enhances the contrast of a cost matrix, in place. Values stay "lower is more alike", and are in standard
/// deviations (but for `kNone`). `kLocal` takes the sample deviation over the window cut at the ends of the
/// reference (Milford and Wyeth 2012, Eq. 3; OpenSeqSLAM). Where there is no deviation (one reference, equal
/// costs) the value is 0: neither alike nor unlike. Throws `std::invalid_argument` if window < 2 or
/// prior_queries < 0. O(queries *
/// references), in parallel; sums in double in a fixed order.
void enhance_contrast(CostMatrix& costs, const ContrastEnhancementOptions& options = {});

/// The same over a matrix that comes in parts, twice: first all are surveyed, then any are enhanced. A part
/// is a stretch of the reference by all queries. The values are those of the whole matrix, to the bit.
class ContrastEnhancer {
 public:
  static constexpr std::size_t kPart = 512;  ///< a surveyed part has a multiple of so many references ...
  static constexpr std::size_t kAlign = 32;  ///< ... an enhanced one begins at a multiple of so many

  /// Throws `std::invalid_argument` if window < 2 or prior_queries < 0. Memory: 16 bytes for each query.
  ContrastEnhancer(std::size_t queries, std::size_t references,
                   const ContrastEnhancementOptions& options = {});

  /// References on either side of a part that its values need; a multiple of kAlign.
  [[nodiscard]] std::size_t margin() const;

  /// The next `count` references, in order; all of them before the first part is enhanced. `costs` has
  /// margin() more on either side as far as the reference goes. `count` is a multiple of kPart, but for the
  /// last. Throws `std::invalid_argument` for costs that are not those.
  void survey(const ConstCosts& costs, std::size_t count);

  /// Enhances a part in place; its outer margin() references, but at the ends of the reference, are left
  /// undefined. Throws `std::invalid_argument` unless all queries are there, it begins at a multiple of
  /// kAlign, and all references were surveyed.
  void enhance(const Costs& costs) const;

  /// Of the enhanced values: their mean, and a bound of how far they lie from it.
  [[nodiscard]] CostRange range() const;

 private:
  std::size_t queries_, references_;
  ContrastEnhancementOptions options_;
  std::size_t surveyed_ = 0;  // references
  // Of each query over the references: while the survey lasts, the sum and the sum of squares.
  std::vector<double> mean_, inverse_deviation_;
  double sum_ = 0, least_ = 0, most_ = 0;  // of what is enhanced, where it is not standardised
};

}  // namespace place
