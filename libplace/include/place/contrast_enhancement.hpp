#pragma once

#include "place/cost_matrix.hpp"

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
};

/// Enhances the contrast of a cost matrix, in place. Values stay "lower is more alike", and are in standard
/// deviations (but for `kNone`). `kLocal` takes the sample deviation over the window cut at the ends of the
/// reference (Milford and Wyeth 2012, Eq. 3; OpenSeqSLAM). Where there is no deviation (one reference, equal
/// costs) the value is 0: neither alike nor unlike. Throws `std::invalid_argument` if window < 2. O(queries *
/// references), in parallel; sums in double in a fixed order.
void enhance_contrast(CostMatrix& costs, const ContrastEnhancementOptions& options = {});

/// The same over rows that come one after another, twice: first all are surveyed, then any are enhanced. The
/// values are those of the whole matrix, to the bit.
class ContrastEnhancer {
 public:
  /// Throws `std::invalid_argument` if window < 2. Memory: 16 bytes for each query and 32 for each reference.
  ContrastEnhancer(std::size_t queries, std::size_t references,
                   const ContrastEnhancementOptions& options = {});

  /// The next whole rows of the matrix, in order; all of them before the first is enhanced.
  void survey(std::span<const float> rows);

  /// Enhances whole rows in place, the first of them that of query `first`.
  void enhance(std::size_t first, std::span<float> rows) const;

  /// Of the enhanced values: their mean, and a bound of how far they lie from it.
  [[nodiscard]] CostRange range() const;

 private:
  /// (value - mean) * inverse, for each query or reference.
  struct Standard {
    std::vector<double> mean, inverse_deviation;
  };
  void survey_references(std::size_t first, std::span<const float> rows);
  void finish_survey();

  std::size_t queries_, references_;
  ContrastEnhancementOptions options_;
  std::size_t surveyed_ = 0;
  Standard query_, reference_;             // while the survey lasts, the reference's sums and sums of squares
  double sum_ = 0, least_ = 0, most_ = 0;  // of what is enhanced, where it is not standardised
};

}  // namespace place
