#pragma once

#include "place/match/costs.hpp"

#include <cstddef>
#include <vector>

#include <vo/image/image_stack.hpp>

namespace place {

/// Settings of `cost_matrix`.
struct CostOptions {
  /// Pixels of the descriptor, less than its width. A pair's cost is the least with the query shifted by up
  /// to this many to either side, for walkers who look a little to the side; 0: no shift.
  int max_shift_px = 0;
};

/// Mean absolute difference of patch-normalised descriptors, in standard deviations of a patch (SSS 3.1
/// and 3.4; SeqSLAM's image difference). Sums are exact integers, so every instruction set, block and number
/// of threads gives the same bytes.
///
/// Each shift is compared over its overlap, a share w = 1 - |s| / width of the picture. The mean d over fewer
/// pixels is more often small by chance, as its spread grows with 1 / sqrt(w). So its distance from c, the
/// mean difference of unrelated places, is weighted by sqrt(w):
///
///   cost = min over s of c + (d - c) sqrt(w)
///
/// c is the mean over pairs of up to 64 references, evenly spaced. With the sum D of differences over the
/// overlap and n pixels in a picture, the cost is D / sqrt(w) + n c (1 - sqrt(w)) units of `unit()`, computed
/// in float and rounded to a whole number, halves up; at a shift of 0 it is D.
class ThumbnailCosts final : public CostSource {
 public:
  /// The stacks are bytes of `vo::patch_normalise`, of the same width and height, and must outlive this.
  /// Throws `std::invalid_argument` if the sizes differ or the shift leaves no column. With a shift, keeps a
  /// copy of both.
  ThumbnailCosts(const vo::ImageStackView& queries, const vo::ImageStackView& references,
                 const CostOptions& options = {});

  [[nodiscard]] std::size_t queries() const override { return queries_.size(); }
  [[nodiscard]] std::size_t references() const override { return references_.size(); }
  [[nodiscard]] float unit() const override;
  /// O(queries * references * pixels * (2 * shift + 1)).
  void compute(const Costs& block) const override;

 private:
  /// A shift: which columns of the query overlap which of the reference, and how their sum becomes a cost.
  struct Shift {
    std::size_t query_column, reference_column, columns;
    float factor, term;
  };

  vo::ImageStackView queries_, references_;
  vo::ImageStack turned_queries_, turned_references_;  ///< column after column; only with shifts
  std::vector<Shift> shifts_;
};

/// The whole matrix of `ThumbnailCosts`.
CostMatrix cost_matrix(const vo::ImageStackView& queries, const vo::ImageStackView& references,
                       const CostOptions& options = {});

}  // namespace place
