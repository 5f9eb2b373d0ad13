#include "place/route/relative_scale.hpp"

#include "place/match/contrast_enhancement.hpp"
#include "place/match/sequence_search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace place {
namespace {

/// Mean cost over all queries of the best line with one slope.
double mean_best_cost(const CostMatrix& enhanced, double slope, int length) {
  const SequenceSearchOptions options{.length = length, .v_min = slope, .v_max = slope};
  double sum = 0;
  for (const SequenceMatch& match : search_sequences(enhanced, options)) sum += match.cost;
  return sum / static_cast<double>(enhanced.queries);
}

}  // namespace

RelativeScale relative_scale(CostMatrix enhanced, const RelativeScaleOptions& options,
                             const ContrastEnhancementOptions& enhancement) {
  if (!(options.largest > 1) || options.steps < 3 || options.length < 2 || !(options.min_gain >= 0)) {
    throw std::invalid_argument(
        "relative_scale: largest > 1, steps >= 3, length >= 2 and min_gain >= 0 expected");
  }
  if (2 * std::min(enhanced.queries, enhanced.references) < 3 * static_cast<std::size_t>(options.length))
    return {};

  enhance_contrast(enhanced, enhancement);
  const double step = 2 * std::log(options.largest) / (options.steps - 1);
  const auto log_scale = [&](std::ptrdiff_t i) {
    return -std::log(options.largest) + static_cast<double>(i) * step;
  };
  std::vector<double> cost;
  for (int i = 0; i < options.steps; ++i)
    cost.push_back(mean_best_cost(enhanced, std::exp(log_scale(i)), options.length));

  std::vector<double> judged = cost;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const double away = log_scale(static_cast<std::ptrdiff_t>(i));
    judged[i] += options.prior_weight * away * away;
  }
  // Slopes that round to the same line cost the same: take the middle of the stretch around the best one.
  const auto best = cost.begin() + (std::ranges::min_element(judged) - judged.begin());
  const auto differs = [&](double c) { return c != *best; };
  const auto last = std::find_if(best, cost.end(), differs) - 1;
  const auto first = std::find_if(std::make_reverse_iterator(best), cost.rend(), differs).base();
  RelativeScale found;
  found.best = std::exp((log_scale(first - cost.begin()) + log_scale(last - cost.begin())) / 2);
  found.gain = mean_best_cost(enhanced, 1, options.length) - *best;
  found.cost = *best;
  if (found.gain >= options.min_gain) found.scale = found.best;
  return found;
}

}  // namespace place
