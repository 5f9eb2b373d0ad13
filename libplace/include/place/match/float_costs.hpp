#pragma once

#include "place/describe/descriptor_options.hpp"
#include "place/describe/float_rows.hpp"
#include "place/match/costs.hpp"

#include <vector>

namespace place {

/// Costs of rows of floats: 1 - cosine (of a row of zeros: 1), the mean absolute difference, or the Euclidean
/// distance, rounded to whole multiples of `unit`. Sums are in float in a fixed order, so the same for any
/// block and number of threads.
class FloatCosts final : public CostSource {
 public:
  /// Both must outlive this. Throws `std::invalid_argument` if their widths differ.
  FloatCosts(const FloatRows& queries, const FloatRows& references, Metric metric);

  [[nodiscard]] std::size_t queries() const override { return queries_.size(); }
  [[nodiscard]] std::size_t references() const override { return references_.size(); }
  [[nodiscard]] float unit() const override { return unit_; }
  void compute(const Costs& block) const override;

 private:
  const FloatRows& queries_;
  const FloatRows& references_;
  Metric metric_;
  std::vector<float> query_lengths_, reference_lengths_;  ///< of the cosine
  float unit_ = 1;
};

}  // namespace place
