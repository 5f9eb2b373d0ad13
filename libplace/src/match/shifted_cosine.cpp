#include "place/match/shifted_cosine.hpp"

#include "kernels/dot_product.hpp"
#include "match/second_level_cache.hpp"
#include "match/shift_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <vector>

#include <vo/base/parallel.hpp>
#include <vo/image/image_stack.hpp>

namespace place {
namespace {

using Bytes = std::vector<std::uint8_t, vo::CacheAligned<std::uint8_t>>;
using SignedBytes = std::vector<std::int8_t, vo::CacheAligned<std::int8_t>>;

constexpr std::size_t kMostBytes = 130'000;  // of a descriptor: 127^2 times that is below 2^31

constexpr std::size_t parts(std::size_t count, std::size_t size) {
  return (count + size - 1) / size;
}

/// The largest magnitude of any value.
int largest_of(const ColumnStack& stack) {
  std::vector<int> largest(stack.size());
  vo::parallel_for(stack.size(), [&](std::size_t i) {
    int most = 0;
    for (const std::int8_t value : stack[i]) most = std::max(most, std::abs(int{value}));
    largest[i] = most;
  });
  return largest.empty() ? 0 : *std::ranges::max_element(largest);
}

ShiftPlan plan_for(const ColumnStack& queries, const ColumnStack& references, int max_shift) {
  const auto columns = static_cast<std::size_t>(queries.columns), shift = static_cast<std::size_t>(max_shift);
  constexpr int kFastShift = 2;
  if (max_shift == kFastShift && std::max(largest_of(queries), largest_of(references)) <= kFastLimit) {
    const auto products = [](const ShiftPlan& plan) {
      std::size_t sum = 0;
      for (const ShiftPlan::Stretch& stretch : plan.stretches) sum += stretch.length;
      return sum;
    };
    ShiftPlan fast = fast_plan(columns);
    if (products(fast) < products(direct_plan(columns, shift))) return fast;
  }
  return direct_plan(columns, shift);
}

/// Sums of squares of the first i columns, i = 0 .. columns.
void add_squares(std::span<const std::int8_t> descriptor, std::span<double> sums) {
  const std::size_t channels = descriptor.size() / (sums.size() - 1);
  sums[0] = 0;
  for (std::size_t i = 0; i + 1 < sums.size(); ++i) {
    std::int32_t sum = 0;
    for (const std::int8_t value : descriptor.subspan(i * channels, channels)) sum += value * value;
    sums[i + 1] = sums[i] + sum;
  }
}

/// sqrt(factor / square), 0 for a square of 0.
float scale_of(double factor, double square) {
  return square == 0 ? 0.0F : static_cast<float>(std::sqrt(factor / square));
}

}  // namespace

struct ShiftedCosine::State {
  State(const ColumnStack& queries, const ColumnStack& references, std::size_t max_shift, ShiftPlan with);

  struct Panel;
  [[nodiscard]] Panel make_panel(std::size_t first, std::size_t count) const;
  void multiply(const std::uint8_t* queries, const Panel& panel, std::size_t stretch,
                std::int32_t* sums) const;
  void write_costs(std::size_t tile, const Panel& panel, const Costs& block, std::span<std::int32_t> sums,
                   std::span<float> costs) const;
  void compute(const Costs& block, std::size_t first, std::size_t count) const;

  /// Bytes of columns of a packed tile or panel.
  [[nodiscard]] std::size_t bytes_of(std::size_t rows, std::size_t columns) const {
    return kernels::packed_bytes(kernel.packing, rows, columns * channels);
  }

  const ColumnStack& references;
  std::size_t query_count;
  const kernels::DotKernels& kernel = kernels::dot_kernels();
  ShiftPlan plan;
  std::size_t channels;  ///< of a packed column
  std::size_t shifts;
  Bytes packed_queries;                               ///< tile by tile
  Bytes packed_zeros;                                 ///< a tile of queries of zeros
  std::vector<float> query_scales, reference_scales;  ///< [keyframe][shift]
};

ShiftedCosine::State::State(const ColumnStack& queries, const ColumnStack& of_reference,
                            std::size_t max_shift, ShiftPlan with)
    : references(of_reference),
      query_count(queries.size()),
      plan(std::move(with)),
      channels(parts(static_cast<std::size_t>(queries.channels), 4) * 4),
      shifts(2 * max_shift + 1),
      query_scales(query_count * shifts),
      reference_scales(references.size() * shifts) {
  const std::size_t columns = plan.columns, row_size = plan.query_columns * channels;
  // The overlap at each shift: the query's columns from `right` on and the reference's from `left` on.
  const auto overlap = [max_shift](std::size_t shift) {
    struct {
      std::size_t right, left;
    } gone{shift > max_shift ? shift - max_shift : 0, shift < max_shift ? max_shift - shift : 0};
    return gone;
  };
  vo::parallel_for(query_count, [&](std::size_t q) {
    std::vector<double> squares(columns + 1);
    add_squares(queries[q], squares);
    for (std::size_t s = 0; s < shifts; ++s) {
      const auto [right, left] = overlap(s);
      const double share = static_cast<double>(columns - right - left) / static_cast<double>(columns);
      query_scales[q * shifts + s] = scale_of(share, squares[columns - left] - squares[right]);
    }
  });
  vo::parallel_for(references.size(), [&](std::size_t r) {
    std::vector<double> squares(columns + 1);
    add_squares(references[r], squares);
    for (std::size_t s = 0; s < shifts; ++s) {
      const auto [right, left] = overlap(s);
      reference_scales[r * shifts + s] = scale_of(1, squares[columns - right] - squares[left]);
    }
  });

  const std::size_t tile_bytes = bytes_of(kernel.queries, plan.query_columns);
  packed_queries.resize(parts(query_count, kernel.queries) * tile_bytes);
  vo::parallel_for(parts(query_count, kernel.queries), [&](std::size_t tile) {
    const std::size_t first = tile * kernel.queries, count = std::min(kernel.queries, query_count - first);
    SignedBytes rows(count * row_size);
    for (std::size_t i = 0; i < count; ++i)
      spread_query(plan, queries[first + i], channels, std::span(rows).subspan(i * row_size, row_size));
    kernels::pack_left(kernel.packing, {rows.data(), count, row_size}, kernel.queries,
                       packed_queries.data() + tile * tile_bytes);
  });
  packed_zeros.resize(tile_bytes);
  kernels::pack_left(kernel.packing, {nullptr, 0, row_size}, kernel.queries, packed_zeros.data());
}

/// Packed references, as many as the kernel processes at once.
struct ShiftedCosine::State::Panel {
  std::size_t first, count;  ///< references of the matrix
  Bytes packed;
  std::vector<float> scales;        ///< [shift][reference]
  std::vector<std::int32_t> start;  ///< [stretch][reference], initial sums
};

void ShiftedCosine::State::multiply(const std::uint8_t* queries, const Panel& panel, std::size_t stretch,
                                    std::int32_t* sums) const {
  const ShiftPlan::Stretch& columns = plan.stretches[stretch];
  kernel.multiply({.queries = queries + bytes_of(kernel.queries, columns.query),
                   .references = panel.packed.data() + bytes_of(kernel.references, columns.reference),
                   .size = columns.length * channels,
                   .start = panel.start.data() + stretch * kernel.references,
                   .sums = sums});
}

ShiftedCosine::State::Panel ShiftedCosine::State::make_panel(std::size_t first, std::size_t count) const {
  const std::size_t wide = kernel.references, row_size = plan.reference_columns * channels;
  Panel panel{.first = first,
              .count = count,
              .packed = Bytes(bytes_of(wide, plan.reference_columns)),
              .scales = std::vector<float>(shifts * wide),
              .start = std::vector<std::int32_t>(plan.stretches.size() * wide)};
  SignedBytes rows(count * row_size);
  for (std::size_t i = 0; i < count; ++i)
    spread_reference(plan, references[first + i], channels, std::span(rows).subspan(i * row_size, row_size));
  kernels::pack_right(kernel.packing, {rows.data(), count, row_size}, wide, panel.packed.data());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t s = 0; s < shifts; ++s)
      panel.scales[s * wide + i] = reference_scales[(first + i) * shifts + s];
  }
  // Sums start from minus the result for zero queries, as the instruction may take offset queries.
  std::vector<std::int32_t> sums(kernel.queries * wide);
  for (std::size_t i = 0; i < plan.stretches.size(); ++i) {
    multiply(packed_zeros.data(), panel, i, sums.data());
    for (std::size_t j = 0; j < wide; ++j) panel.start[i * wide + j] = -sums[j];
  }
  return panel;
}

/// The costs of one tile of a block's queries with a panel. `sums`: for every stretch [query][reference].
void ShiftedCosine::State::write_costs(std::size_t tile, const Panel& panel, const Costs& block,
                                       std::span<std::int32_t> sums, std::span<float> costs) const {
  const std::size_t tall = kernel.queries, wide = kernel.references;
  for (std::size_t i = 0; i < plan.stretches.size(); ++i) {
    multiply(packed_queries.data() + tile * bytes_of(tall, plan.query_columns), panel, i,
             sums.data() + i * tall * wide);
  }
  const std::size_t begin = std::max(tile * tall, block.first_query),
                    end = std::min(block.first_query + block.queries, (tile + 1) * tall);
  for (std::size_t q = begin; q < end; ++q) {
    float* const out =
        block.values + (q - block.first_query) * block.stride + (panel.first - block.first_reference);
    const kernels::ShiftCosts of_query{.sums = sums.data() + (q - tile * tall) * wide,
                                       .stride = tall * wide,
                                       .shifts = shifts,
                                       .query_scales = query_scales.data() + q * shifts,
                                       .reference_scales = panel.scales.data(),
                                       .costs = panel.count == wide ? out : costs.data()};
    plan.fast ? kernel.costs_of_five(of_query) : kernel.costs(of_query);
    if (panel.count < wide) std::copy_n(costs.data(), panel.count, out);
  }
}

/// The costs of a block for its references [first, first + count).
void ShiftedCosine::State::compute(const Costs& block, std::size_t first, std::size_t count) const {
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < count; i += kernel.references)
    panels.push_back(make_panel(first + i, std::min(kernel.references, count - i)));
  std::vector<std::int32_t> sums(plan.stretches.size() * kernel.queries * kernel.references);
  std::vector<float> costs(kernel.references);
  const std::size_t past = block.first_query + block.queries;
  for (std::size_t tile = block.first_query / kernel.queries; tile * kernel.queries < past; ++tile) {
    for (const Panel& panel : panels) write_costs(tile, panel, block, sums, costs);
  }
}

ShiftedCosine::ShiftedCosine(const ColumnStack& queries, const ColumnStack& references,
                             const ShiftedCosineOptions& options) {
  if (queries.columns != references.columns || queries.channels != references.channels) {
    throw std::invalid_argument("ShiftedCosine: query and reference descriptors differ in size");
  }
  const int shift = options.max_shift_columns;
  if (shift < 0 || shift >= queries.columns) {
    throw std::invalid_argument("ShiftedCosine: 0 <= max_shift_columns < columns expected");
  }
  if (queries.descriptor_size() > kMostBytes) {
    throw std::invalid_argument("ShiftedCosine: descriptors of at most 130000 bytes expected");
  }
  const auto has_lowest = [](const ColumnStack& stack) { return largest_of(stack) > 127; };
  if (has_lowest(queries) || has_lowest(references)) {
    throw std::invalid_argument("ShiftedCosine: values of -127 to 127 expected");
  }
  state_ = std::make_unique<const State>(queries, references, static_cast<std::size_t>(shift),
                                         plan_for(queries, references, shift));
}

ShiftedCosine::~ShiftedCosine() = default;

std::size_t ShiftedCosine::queries() const {
  return state_->query_count;
}

std::size_t ShiftedCosine::references() const {
  return state_->references.size();
}

float ShiftedCosine::unit() const {
  return 1 / kernels::kCostUnits;
}

void ShiftedCosine::compute(const Costs& block) const {
  if (block.queries == 0) return;
  // Panels fill half the second-level cache and stay there while the queries stream past.
  const std::size_t panel_bytes = state_->bytes_of(state_->kernel.references, state_->plan.reference_columns);
  const std::size_t panels = std::max<std::size_t>(1, second_level_cache() / 2 / panel_bytes);
  const std::size_t together = panels * state_->kernel.references;
  vo::parallel_for(parts(block.references, together), [&](std::size_t i) {
    const std::size_t first = i * together, count = std::min(together, block.references - first);
    state_->compute(block, block.first_reference + first, count);
  });
}

}  // namespace place
