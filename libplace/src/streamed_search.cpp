#include "place/streamed_search.hpp"

#include "place/sequence_searcher.hpp"

#include <algorithm>

#include <vo/base/large_memory.hpp>

namespace place {
namespace {

constexpr std::size_t kRows = 96;  // of a block: those that the cost kernels take together

/// Calls `body(first, count)` for blocks of the queries in order.
template <typename Body>
void for_each_block(std::size_t queries, const Body& body) {
  for (std::size_t first = 0; first < queries; first += kRows) body(first, std::min(kRows, queries - first));
}

}  // namespace

std::vector<SequenceMatch> search_streamed(const vo::ImageStack& queries, const vo::ImageStack& references,
                                           const StreamedSearchOptions& options, const RowsCallback& rows) {
  const CostRows costs(queries, references, options.cost);
  const std::size_t width = costs.references();
  ContrastEnhancer enhancer(costs.queries(), width, options.enhancement);

  // The first pass: what enhancement must know of all costs. As many rows as may be kept are.
  const std::size_t whole_blocks =
      options.kept_bytes / (std::max<std::size_t>(1, width) * sizeof(float) * kRows);
  const std::size_t kept_rows = std::min(costs.queries(), whole_blocks * kRows);
  std::vector<float> kept, passing;
  vo::resize_populated(kept, kept_rows * width);
  const auto block = [&](std::size_t first, std::size_t count) {
    if (first < kept_rows) return std::span(kept).subspan(first * width, count * width);
    passing.resize(kRows * width);
    return std::span(passing).first(count * width);
  };
  for_each_block(costs.queries(), [&](std::size_t first, std::size_t count) {
    const std::span<float> values = block(first, count);
    costs.compute(first, count, values);
    enhancer.survey(values);
  });

  // The second: enhanced, and searched.
  SequenceSearcher searcher(costs.queries(), width, enhancer.range(), options.search);
  std::vector<float> raw;
  for_each_block(costs.queries(), [&](std::size_t first, std::size_t count) {
    const std::span<float> values = block(first, count);
    if (first >= kept_rows) costs.compute(first, count, values);
    if (rows) raw.assign(values.begin(), values.end());
    enhancer.enhance(first, values);
    if (rows) rows({.first = first, .cost = raw, .enhanced = values});
    searcher.push(values);
  });
  return searcher.finish();
}

}  // namespace place
