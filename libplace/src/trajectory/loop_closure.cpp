#include "place/trajectory/loop_closure.hpp"

#include "place/match/cost_matrix.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace place {
namespace {

/// The number of keyframes, from the first, that are in the past at this travelled distance.
std::size_t past_of(std::span<const double> travelled_m, std::size_t node, double recent_m) {
  return static_cast<std::size_t>(std::ranges::lower_bound(travelled_m, travelled_m[node] - recent_m) -
                                  travelled_m.begin());
}

/// The enhanced costs of the past. Other keyframes, mostly other places, count in means and deviations and
/// then get an average cost, so that only similar places match.
CostMatrix costs_of_the_past(const vo::ImageStack& thumbnails, const std::vector<std::size_t>& past,
                             const LoopClosureOptions& options) {
  const vo::ImageStack normalised = vo::patch_normalise(thumbnails, options.patch);
  CostMatrix costs = cost_matrix(normalised, normalised);
  enhance_contrast(costs, options.enhancement);
  for (std::size_t q = 0; q < costs.queries; ++q) std::ranges::fill(costs.row(q).subspan(past[q]), 0.0F);
  return costs;
}

}  // namespace

std::vector<LoopClosure> find_loops(const vo::ImageStack& thumbnails, std::span<const double> travelled_m,
                                    const LoopClosureOptions& options) {
  if (thumbnails.size() != travelled_m.size())
    throw std::invalid_argument("find_loops: one distance for each thumbnail expected");
  if (std::string reason; !options.search.is_valid(&reason))
    throw std::invalid_argument("find_loops: " + reason);
  std::vector<LoopClosure> loops;
  const auto length = static_cast<std::size_t>(options.search.length);
  if (travelled_m.size() < 2 * length || travelled_m.back() - travelled_m.front() <= options.recent_m)
    return loops;

  std::vector<std::size_t> past;
  for (std::size_t q = 0; q < travelled_m.size(); ++q)
    past.push_back(past_of(travelled_m, q, options.recent_m));
  const CostMatrix costs = costs_of_the_past(thumbnails, past, options);
  const std::vector<SequenceMatch> matches = search_sequences(costs, options.search);
  const auto matched = [&](std::size_t q) {
    return matches[q].reference && *matches[q].reference < past[q] &&
           static_cast<double>(matches[q].score) >= options.least_score;
  };
  for (std::size_t q = 0; q < matches.size(); ++q) {
    if (!matched(q)) continue;
    // Neighbours whose matches are as far from this one's match as they are from it, up to rounding.
    constexpr std::ptrdiff_t kOff = 2;
    std::size_t along = 0, all = 0;
    for (std::size_t n = q - std::min(q, length / 2); n < std::min(matches.size(), q + length / 2 + 1); ++n) {
      ++all;
      if (!matched(n)) continue;
      const auto moved = static_cast<std::ptrdiff_t>(*matches[n].reference) -
                         static_cast<std::ptrdiff_t>(*matches[q].reference);
      if (std::abs(moved - (static_cast<std::ptrdiff_t>(n) - static_cast<std::ptrdiff_t>(q))) <= kOff)
        ++along;
    }
    if (static_cast<double>(along) < options.least_share * static_cast<double>(all)) continue;
    loops.push_back({.node = q, .earlier = *matches[q].reference, .score = matches[q].score});
  }
  return loops;
}

}  // namespace place
