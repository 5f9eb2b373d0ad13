#include "vo/geometry/view_turn.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace vo {
namespace {

constexpr double kWithin = 2;  // deviations: 95 % of those that agree

/// Where the sum of Gaussians about the votes is highest.
double highest(const std::vector<double>& votes, double spread) {
  const auto weight = [&](double vote, double at) {
    const double off = (vote - at) / spread;
    return std::exp(-off * off / 2);
  };
  double best = 0, peak = 0;
  for (const double at : votes) {
    double height = 0;
    for (const double vote : votes) height += weight(vote, at);
    if (height > best) {
      best = height;
      peak = at;
    }
  }
  constexpr int kRounds = 5;  // of mean shift; what is left is far below the spread
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0, weights = 0;
    for (const double vote : votes) {
      const double w = weight(vote, peak);
      sum += w * vote;
      weights += w;
    }
    peak = sum / weights;
  }
  return peak;
}

}  // namespace

std::optional<ViewTurn> view_turn(std::span<const float> from_rad, std::span<const float> to_rad,
                                  const ViewTurnOptions& options) {
  if (from_rad.size() != to_rad.size())
    throw std::invalid_argument("view_turn: the same points in both views expected");
  if (!(options.spread_rad > 0)) throw std::invalid_argument("view_turn: spread_rad > 0 expected");
  if (from_rad.empty()) return std::nullopt;
  std::vector<double> votes;  // a point moves to the left as the camera turns to the right
  for (std::size_t i = 0; i < from_rad.size(); ++i) votes.push_back(double{from_rad[i]} - to_rad[i]);
  ViewTurn result{.turn_rad = highest(votes, options.spread_rad)};
  const double window_rad = kWithin * options.spread_rad;
  result.agreeing = static_cast<std::size_t>(std::ranges::count_if(
      votes, [&](double vote) { return std::abs(vote - result.turn_rad) <= window_rad; }));

  // Differences of two azimuths of a range spread like a triangle, whose foot is twice the range.
  const auto [from_least, from_most] = std::ranges::minmax(from_rad);
  const auto [to_least, to_most] = std::ranges::minmax(to_rad);
  const double range_rad =
      std::max({double{from_most} - from_least, double{to_most} - to_least, 2 * window_rad});
  const double share =
      2 * window_rad * std::max(range_rad - std::abs(result.turn_rad), window_rad) / (range_rad * range_rad);
  const double chance = static_cast<double>(votes.size()) * std::min(share, 1.0);
  const double least = chance + options.min_over_chance * std::sqrt(chance);
  if (result.agreeing < options.min_agreeing || static_cast<double>(result.agreeing) < least)
    return std::nullopt;
  return result;
}

}  // namespace vo
