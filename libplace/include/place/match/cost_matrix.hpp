#pragma once

#include "place/match/costs.hpp"

#include <cstddef>

#include <vo/image/image_stack.hpp>

namespace place {

/// Settings of `cost_matrix`.
struct CostOptions {
  /// Pixels of the descriptor. A pair's cost is the least over the query moved by up to so many to either
  /// side, for walkers who look a little to the side; 0 compares it as it is. Every shift is judged on the
  /// same part of the reference, that which all of them cover, so that none has an advantage; the outer
  /// columns do not count.
  int max_shift_px = 0;
};

/// Mean absolute differences of patch-normalised descriptors, see `cost_matrix`.
class ThumbnailCosts final : public CostSource {
 public:
  /// The stacks are bytes of `vo::patch_normalise`, of the same width and height, and must outlive this.
  /// Throws `std::invalid_argument` if the sizes differ or the shift leaves no column. With a shift, copies
  /// the references and 2 * max_shift_px + 1 times the queries.
  ThumbnailCosts(const vo::ImageStack& queries, const vo::ImageStack& references,
                 const CostOptions& options = {});

  [[nodiscard]] std::size_t queries() const override { return queries_; }
  [[nodiscard]] std::size_t references() const override { return reference_images().size(); }
  [[nodiscard]] float unit() const override;
  void compute(const Costs& block) const override;

 private:
  [[nodiscard]] const vo::ImageStack& query_images() const { return variants_ > 1 ? shifted_ : *whole_; }
  [[nodiscard]] const vo::ImageStack& reference_images() const {
    return variants_ > 1 ? cropped_ : *whole_references_;
  }

  std::size_t queries_;
  std::size_t variants_ = 1;  ///< of each query, one after another
  const vo::ImageStack* whole_;
  const vo::ImageStack* whole_references_;
  vo::ImageStack shifted_, cropped_;
};

/// Mean absolute difference of patch-normalised descriptors, in standard deviations of a patch (SSS 3.1
/// and 3.4; SeqSLAM's image difference). Sums are exact integers, so every instruction set gives the same
/// bytes.
///
/// Both stacks: bytes of `vo::patch_normalise`, of the same width and height. Throws `std::invalid_argument`
/// if the sizes differ or the shift leaves no column. O(queries * references * pixels * (2 * shift + 1)), in
/// parallel.
CostMatrix cost_matrix(const vo::ImageStack& queries, const vo::ImageStack& references,
                       const CostOptions& options = {});

}  // namespace place
