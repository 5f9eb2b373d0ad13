#include "place/certainty/place_spread.hpp"

#include "certainty/part_certainty.hpp"
#include "match/messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace place {
namespace {

double spread_of(const MatrixPart& enhanced, std::size_t query, const SequenceMatch& match, int window) {
  constexpr int kHalf = 2;  // queries on either side
  constexpr double kSteepness = 0.5, kBetweenKeyframes = 0.5;
  const auto queries = static_cast<std::ptrdiff_t>(enhanced.queries());
  const auto references = static_cast<std::ptrdiff_t>(enhanced.references);
  const auto centre = static_cast<std::ptrdiff_t>(*match.reference);
  std::vector<double> places, sums;
  for (std::ptrdiff_t d = -window; d <= window; ++d) {
    if (centre + d < 0 || centre + d >= references) continue;
    double sum = 0;
    for (int k = -kHalf; k <= kHalf; ++k) {
      const std::ptrdiff_t q = static_cast<std::ptrdiff_t>(query) + k;
      const std::ptrdiff_t r = centre + d + std::lround(k * match.slope);
      // Outside the matrix nothing is known: use an average cost.
      if (q < 0 || q >= queries || r < 0 || r >= references) continue;
      sum += static_cast<double>(
          enhanced.costs.at(static_cast<std::size_t>(q), static_cast<std::size_t>(r) - enhanced.first));
    }
    places.push_back(static_cast<double>(d));
    sums.push_back(sum);
  }
  const double least = *std::ranges::min_element(sums);
  double total = 0, mean = 0, variance = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] = std::exp(-kSteepness * (sums[i] - least));
    total += sums[i];
    mean += sums[i] * places[i];
  }
  mean /= total;
  for (std::size_t i = 0; i < sums.size(); ++i)
    variance += sums[i] * (places[i] - mean) * (places[i] - mean) / total;
  return std::sqrt(variance + kBetweenKeyframes * kBetweenKeyframes);
}

}  // namespace

std::vector<std::optional<double>> place_spread(const CostView& enhanced,
                                                std::span<const SequenceMatch> matches, int window) {
  Alone alone;
  return place_spread_part(whole_of(enhanced), matches, window, alone);
}

std::vector<std::optional<double>> place_spread_part(const MatrixPart& enhanced,
                                                     std::span<const SequenceMatch> matches, int window,
                                                     Team& team) {
  if (matches.size() != enhanced.queries())
    throw std::invalid_argument("place_spread: one match for each query expected");
  if (window < 0) throw std::invalid_argument("place_spread: window >= 0 expected");
  constexpr double kNotMine = -1;
  std::vector<double> mine(matches.size(), kNotMine);
  for (std::size_t q = 0; q < matches.size(); ++q) {
    if (!matches[q].reference) continue;
    if (*matches[q].reference >= enhanced.references)
      throw std::invalid_argument("place_spread: matches on the reference expected");
    if (enhanced.has(*matches[q].reference)) mine[q] = spread_of(enhanced, q, matches[q], window);
  }
  std::vector<std::optional<double>> spread(matches.size());
  for (const std::vector<double>& member : exchange_all(team, std::span<const double>(mine)))
    for (std::size_t q = 0; q < spread.size(); ++q)
      if (member[q] != kNotMine) spread[q] = member[q];
  return spread;
}

}  // namespace place
