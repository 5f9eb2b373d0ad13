#pragma once

#include "place/describe/descriptor_options.hpp"
#include "place/describe/float_rows.hpp"
#include "place/match/costs.hpp"

#include <cstddef>
#include <vector>

namespace place {

/// Costs of float descriptors, such as those of other models: 1 - cosine, mean absolute difference, or
/// Euclidean distance. The cosine with a row of zeros (shorter than 1e-15) is 0.
///
/// Sums are in float, term by term in the order of the values, each step rounded to float, so they are the
/// same for any instruction set, block and number of threads. Costs are rounded to multiples of `unit()`,
/// ties to even: 2^-15 for the cosine; for the others the power of two that makes the largest possible cost
/// of these rows, by the triangle inequality, 2^14 to 2^15 units.
class FloatCosts final : public CostSource {
 public:
  /// Rows of one width, finite; those of the references must outlive this. Throws `std::invalid_argument` if
  /// widths differ, a value is not finite, or a row's sum of squares overflows a float.
  FloatCosts(const FloatRowsView& queries, const FloatRowsView& references, Metric metric);

  [[nodiscard]] std::size_t queries() const override { return query_count_; }
  [[nodiscard]] std::size_t references() const override { return references_.size(); }
  [[nodiscard]] float unit() const override { return 1 / units_; }
  /// O(queries * references * width).
  void compute(const Costs& block) const override;

 private:
  void compute_panel(const Costs& block, std::size_t first, std::size_t count) const;

  FloatRowsView references_;
  Metric metric_;
  std::size_t query_count_;
  float units_;
  std::vector<float> packed_queries_;                   ///< tile by tile
  std::vector<float> query_scales_, reference_scales_;  ///< of each row
};

}  // namespace place
