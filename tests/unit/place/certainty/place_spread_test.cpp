#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <place/certainty/place_spread.hpp>

namespace {

using place::CostMatrix;
using place::make_cost_matrix;
using place::place_spread;
using place::SequenceMatch;

/// A walk along the diagonal whose costs rise by `curvature` / 2 * d^2 with the distance d from the true
/// place.
CostMatrix valley(std::size_t queries, std::size_t references, double curvature) {
  CostMatrix costs = make_cost_matrix(queries, references);
  for (std::size_t q = 0; q < queries; ++q) {
    for (std::size_t r = 0; r < references; ++r) {
      const double d = static_cast<double>(r) - static_cast<double>(q);
      costs.row(q)[r] = static_cast<float>(curvature / 2 * d * d);
    }
  }
  return costs;
}

std::vector<SequenceMatch> diagonal(std::size_t queries) {
  std::vector<SequenceMatch> matches(queries);
  for (std::size_t q = 0; q < queries; ++q) matches[q].reference = q;
  return matches;
}

TEST(PlaceSpread, FollowsTheCurvatureOfTheCosts) {
  // Five queries of curvature c, half as steep: a normal density of variance 1 / (2.5 c), and a quarter for
  // what lies between keyframes. At 0.1 it is 2 keyframes wide: 5 deviations lie within the window.
  const auto spread = place_spread(valley(50, 50, 0.1), diagonal(50));
  for (std::size_t q = 15; q < 35; ++q) EXPECT_NEAR(*spread[q], std::sqrt(4 + 0.25), 0.01) << q;
}

TEST(PlaceSpread, OfASharpDipIsHalfAKeyframe) {
  EXPECT_NEAR(*place_spread(valley(50, 50, 50), diagonal(50))[25], 0.5, 1e-6);
}

TEST(PlaceSpread, OfFlatCostsIsTheWindows) {
  // Uniform over -10 .. 10: variance 10 * 11 / 3.
  const auto spread = place_spread(make_cost_matrix(50, 50), diagonal(50));
  EXPECT_NEAR(*spread[25], std::sqrt(110 / 3.0 + 0.25), 1e-9);
  // At the end of the reference half of the window is missing: -10 .. 0, variance 10 * 12 / 12.
  EXPECT_NEAR(*spread[49], std::sqrt(10 + 0.25), 1e-9);
}

TEST(PlaceSpread, IsNoneWithoutAMatch) {
  std::vector<SequenceMatch> matches(2);
  matches[1].reference = 0;
  const auto spread = place_spread(make_cost_matrix(2, 1), matches);
  EXPECT_EQ(spread[0], std::nullopt);
  EXPECT_NEAR(*spread[1], 0.5, 1e-9);  // there is one place only
  EXPECT_TRUE(place_spread(make_cost_matrix(0, 0), {}).empty());
}

TEST(PlaceSpread, RefusesMatchesOfAnotherSearch) {
  EXPECT_THROW(place_spread(make_cost_matrix(3, 3), diagonal(2)), std::invalid_argument);
  EXPECT_THROW(place_spread(make_cost_matrix(3, 2), diagonal(3)), std::invalid_argument);
}

}  // namespace
