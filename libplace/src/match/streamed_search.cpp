#include "place/match/streamed_search.hpp"

#include "match/cost_cache.hpp"
#include "place/match/sequence_searcher.hpp"

#include <algorithm>

#include <vo/base/large_memory.hpp>

namespace place {
namespace {

constexpr std::size_t round_up(std::size_t value, std::size_t step) {
  return (value + step - 1) / step * step;
}

/// References in a part: few enough that all queries' costs fit a cache, no fewer than the searcher needs,
/// and several times the margin that lines reach, which is enhanced for two parts.
std::size_t part_width(std::size_t queries, std::size_t reach, std::size_t window) {
  constexpr std::size_t kBytes = 16 << 20, kStep = ContrastEnhancer::kPart, kMost = 16 * kStep;
  const std::size_t fitting = kBytes / sizeof(float) / std::max<std::size_t>(1, queries) / kStep * kStep;
  return std::max({std::clamp(fitting, kStep, kMost), round_up(4 * reach, kStep), round_up(window, kStep)});
}

}  // namespace

std::vector<SequenceMatch> search_streamed(const vo::ImageStack& queries, const vo::ImageStack& references,
                                           const StreamedSearchOptions& options,
                                           const MatrixCallbacks& callbacks) {
  return search_streamed(ThumbnailCosts(queries, references, options.cost), options, callbacks);
}

std::vector<SequenceMatch> search_streamed(const CostSource& source, const StreamedSearchOptions& options,
                                           const MatrixCallbacks& callbacks) {
  const std::size_t width = source.references();
  ContrastEnhancer enhancer(source.queries(), width, options.enhancement);
  CostCache cache(source, options.kept_bytes);
  const std::size_t reach = round_up(reach_of(search_lines(options.search)), ContrastEnhancer::kAlign);
  const std::size_t part =
      part_width(source.queries(), reach, static_cast<std::size_t>(options.search.uniqueness_window));
  const auto values =
      vo::make_large_array<float>(source.queries() * std::min(width, part + 2 * (reach + enhancer.margin())));
  const auto with_margin = [&](std::size_t first, std::size_t count, std::size_t margin) {
    const std::size_t begin = first - std::min(first, margin),
                      stride = std::min(width, first + count + margin) - begin;
    return Costs{0, source.queries(), begin, stride, values.get(), stride};
  };
  const auto for_each_part = [&](const auto& body) {
    for (std::size_t first = 0; first < width; first += part) body(first, std::min(part, width - first));
  };

  // The first pass collects what enhancement needs from all costs.
  for_each_part([&](std::size_t first, std::size_t count) {
    const Costs costs = with_margin(first, count, enhancer.margin());
    source.compute(costs);
    cache.keep(costs.columns(first, count));
    enhancer.survey(costs, count);
  });

  // The second pass enhances and searches.
  SequenceSearcher searcher(source.queries(), width, enhancer.range(), options.search);
  for_each_part([&](std::size_t first, std::size_t count) {
    const Costs costs = with_margin(first, count, reach + enhancer.margin());
    cache.fetch(costs);
    if (callbacks.cost) callbacks.cost(costs.columns(first, count));
    enhancer.enhance(costs);
    if (callbacks.enhanced) callbacks.enhanced(costs.columns(first, count));
    const std::size_t begin = first - std::min(first, reach), past = std::min(width, first + count + reach);
    searcher.push(costs.columns(begin, past - begin), count);
  });
  return searcher.finish();
}

}  // namespace place
