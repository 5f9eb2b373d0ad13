#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/team.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace place {

/// How the rows of a cost matrix are made comparable before sequences are searched.
enum class Enhancement {
  kNone,         ///< costs as they are
  kLocal,        ///< SeqSLAM's: each cost relative to its neighbours along the reference
  kStandardise,  ///< each query over all references, then each reference over all queries, to mean 0 and
                 ///< deviation 1
};

/// Settings of `enhance_contrast`.
struct ContrastEnhancementOptions {
  Enhancement method = Enhancement::kStandardise;
  int window = 10;  ///< keyframes, `kLocal`: neighbours up to window / 2 on either side (SeqSLAM: R = 10)
  /// `kStandardise`: a reference's mean and variance over few queries are uncertain, so they are drawn
  /// towards 0 and 1, the values after standardising rows, as if this many more queries had been seen: with w
  /// = queries / (queries + prior_queries), (x - w mean) / sqrt(w variance + 1 - w). 0: not drawn.
  double prior_queries = 0;
};

/// Enhances the contrast of a cost matrix, in place. Lower values still mean more alike, and are in standard
/// deviations (except `kNone`). `kLocal` uses the sample deviation over the window, cut off at the ends of
/// the reference (Milford and Wyeth 2012, Eq. 3; OpenSeqSLAM). Where there is no deviation (one reference,
/// equal costs) the value is 0: neither alike nor unlike. Throws `std::invalid_argument` if window < 2 or
/// prior_queries < 0. O(queries * references), in parallel; sums in double in a fixed order.
void enhance_contrast(CostMatrix& costs, const ContrastEnhancementOptions& options = {});

/// The same for a matrix in parts, in two passes: first all are surveyed, then any are enhanced. A part is a
/// stretch of the reference by all queries. The values equal those of the whole matrix, to the bit.
class ContrastEnhancer {
 public:
  static constexpr std::size_t kPart = 512;  ///< a surveyed part has a multiple of this many references ...
  static constexpr std::size_t kAlign = 32;  ///< ... an enhanced one begins at a multiple of this many

  /// Throws `std::invalid_argument` if window < 2 or prior_queries < 0. Memory: 32 bytes for each query and
  /// doubling of the references.
  ContrastEnhancer(std::size_t queries, std::size_t references,
                   const ContrastEnhancementOptions& options = {});

  /// The same for a shard: only its references are surveyed here, and then `share` adds what the other
  /// members of a team surveyed. Columns are numbered from `first` on, the first that this member has.
  ContrastEnhancer(std::size_t queries, std::size_t references, const ContrastEnhancementOptions& options,
                   const Shard& own, std::size_t first);

  /// References on either side of a part that its values need; a multiple of kAlign.
  [[nodiscard]] std::size_t margin() const;

  /// Takes the next `count` references, in order; all of them before the first part is enhanced. `costs` has
  /// margin() more on either side, as far as the reference goes. `count` is a multiple of kPart, except for
  /// the last part. Throws `std::invalid_argument` for other costs.
  void survey(const ConstCosts& costs, std::size_t count);

  /// Adds up the surveys of all members, in an order that does not depend on how many there are. Without a
  /// team, the last part surveyed does it.
  void share(Team& team);

  /// Enhances a part in place; its outer margin() references are left undefined, except at the ends of the
  /// reference. Throws `std::invalid_argument` unless it has all queries, begins at a multiple of kAlign, and
  /// all references were surveyed.
  void enhance(const Costs& costs) const;

  /// The mean of the enhanced values, and a bound on their distance from it.
  [[nodiscard]] CostRange range() const;

 private:
  struct Survey;
  void standardise_by(const Survey& survey);

  std::size_t queries_, references_;
  ContrastEnhancementOptions options_;
  std::size_t begin_ = 0, end_;  // references to survey here, numbered like the columns
  std::size_t surveyed_;         // up to this one
  bool alone_ = false, ready_ = false;
  std::shared_ptr<Survey> survey_;                // until all are surveyed
  std::vector<double> mean_, inverse_deviation_;  // for each query over the references
  double sum_ = 0, least_ = 0, most_ = 0;         // of the enhanced values, unless standardised
};

}  // namespace place
