#include "place/match/float_costs.hpp"

#include "kernels/float_sums.hpp"
#include "kernels/interleave.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr std::size_t parts(std::size_t count, std::size_t size) {
  return (count + size - 1) / size;
}

/// The length of each row in the metric.
std::vector<double> lengths_of(const FloatRowsView& rows, Metric metric) {
  std::vector<double> lengths(rows.size());
  vo::parallel_for(rows.size(), [&](std::size_t i) {
    double sum = 0, squares = 0;
    for (const float value : rows[i]) {
      sum += std::abs(static_cast<double>(value));
      squares += static_cast<double>(value) * static_cast<double>(value);
    }
    constexpr double kMost =
        std::numeric_limits<float>::max() / 8.0;  // the difference of two rows can have four times that
    lengths[i] = squares < kMost
                     ? (metric == Metric::kL1 ? sum / static_cast<double>(rows.width) : std::sqrt(squares))
                     : std::numeric_limits<double>::infinity();
  });
  return lengths;
}

double largest_of(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::ranges::max_element(values);
}

}  // namespace

FloatCosts::FloatCosts(const FloatRowsView& queries, const FloatRowsView& references, Metric metric)
    : references_(references), metric_(metric), query_count_(queries.size()) {
  if (queries.width != references.width) {
    throw std::invalid_argument("FloatCosts: query and reference descriptors differ in size");
  }
  const std::vector<double> of_queries = lengths_of(queries, metric),
                            of_references = lengths_of(references, metric);
  const double furthest = largest_of(of_queries) + largest_of(of_references);
  if (!std::isfinite(furthest)) {
    throw std::invalid_argument("FloatCosts: finite values, whose squares add up within a float, expected");
  }
  constexpr int kBits = 15;
  int exponent = 1;  // no cosine costs more than 2^1
  if (metric != Metric::kCosine) std::frexp(furthest, &exponent);
  units_ = std::ldexp(1.0F, metric == Metric::kCosine ? kBits : std::clamp(kBits - exponent, -100, 100));
  if (metric == Metric::kCosine) {
    constexpr double kShortest = 1e-15;  // products of shorter rows may vanish
    const auto inverse = [](double length) {
      return length > kShortest ? static_cast<float>(1 / length) : 0.0F;
    };
    std::ranges::transform(of_queries, std::back_inserter(query_scales_), inverse);
    std::ranges::transform(of_references, std::back_inserter(reference_scales_), inverse);
  }
  const std::size_t tall = kernels::float_kernels().queries;
  packed_queries_.resize(parts(query_count_, tall) * tall * queries.width);
  for (std::size_t first = 0; first < query_count_; first += tall) {
    kernels::interleave(queries, {first, std::min(tall, query_count_ - first), 0, queries.width}, tall,
                        packed_queries_.data() + first * queries.width);
  }
}

void FloatCosts::compute(const Costs& block) const {
  if (block.queries == 0) return;
  const std::size_t wide = kernels::float_kernels().references;
  vo::parallel_for(parts(block.references, wide), [&](std::size_t panel) {
    const std::size_t first = panel * wide;
    compute_panel(block, block.first_reference + first, std::min(wide, block.references - first));
  });
}

/// The costs of a block for its references [first, first + count), a panel at most.
void FloatCosts::compute_panel(const Costs& block, std::size_t first, std::size_t count) const {
  const kernels::FloatKernels& kernel = kernels::float_kernels();
  const std::size_t tall = kernel.queries, wide = kernel.references, width = references_.width;
  std::vector<float> panel(wide * width), sums(tall * wide), scales(wide), costs(wide);
  kernels::interleave(references_, {first, count, 0, width}, wide, panel.data());
  const bool cosine = metric_ == Metric::kCosine;
  if (cosine)
    std::copy_n(reference_scales_.begin() + static_cast<std::ptrdiff_t>(first), count, scales.begin());
  const kernels::Term term = cosine                   ? kernels::Term::kProduct
                             : metric_ == Metric::kL1 ? kernels::Term::kAbsoluteDifference
                                                      : kernels::Term::kSquaredDifference;
  const float mean = metric_ == Metric::kL1 ? 1 / static_cast<float>(width) : 1.0F;
  const std::size_t past = block.first_query + block.queries;
  for (std::size_t tile = block.first_query / tall; tile * tall < past; ++tile) {
    kernel.add(term, {packed_queries_.data() + tile * tall * width, panel.data(), width, sums.data()});
    const std::size_t begin = std::max(tile * tall, block.first_query),
                      end = std::min(past, (tile + 1) * tall);
    for (std::size_t q = begin; q < end; ++q) {
      kernel.costs({.sums = sums.data() + (q - tile * tall) * wide,
                    .reference_scales = cosine ? scales.data() : nullptr,
                    .query_scale = cosine ? query_scales_[q] : mean,
                    .root = metric_ == Metric::kL2,
                    .units = units_,
                    .costs = costs.data()});
      std::copy_n(costs.data(), count,
                  block.values + (q - block.first_query) * block.stride + (first - block.first_reference));
    }
  }
}

}  // namespace place
