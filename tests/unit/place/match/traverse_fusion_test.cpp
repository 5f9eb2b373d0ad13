#include "support/drawn_costs.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/contrast_enhancement.hpp>
#include <place/match/search_method.hpp>
#include <place/match/traverse_fusion.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::CostMatrix;
using place::FurtherCosts;
using place::fuse_traverses;
using place::inverse_map;
using place::map_from_matches;
using place::SureMatch;
using place::TraverseMap;
using test_support::chance_costs;
using test_support::walked_costs;
using testing::ElementsAre;
using testing::IsEmpty;

SureMatch sure(std::size_t reference, double probability = 0.99) {
  return {.match = {.reference = reference}, .probability = probability, .sd_keyframes = {}};
}

TEST(TraverseMap, GoesThroughTheSureMatches) {
  const std::vector<SureMatch> matches{sure(4), sure(90, 0.5), SureMatch{}, sure(7), sure(8)};
  EXPECT_THAT(map_from_matches(matches), ElementsAre(4, 5, 6, 7, 8));
}

TEST(TraverseMap, LeavesOutWhatGoesBackOrLiesFarFromAMatch) {
  std::vector<SureMatch> matches(16);
  matches[0] = sure(20);
  matches[1] = sure(50);  // a false place: 50 and 22 cannot both be right
  matches[2] = sure(22);
  matches[3] = sure(23);
  matches[15] = sure(35);
  const TraverseMap map = map_from_matches(matches);
  EXPECT_THAT(std::vector(map.begin(), map.begin() + 4), ElementsAre(20, 21, 22, 23));
  for (std::size_t i = 4; i < 15; ++i) EXPECT_EQ(map[i], std::nullopt) << i;
  EXPECT_EQ(map[15], 35);
}

TEST(TraverseMap, HasAnInverse) {
  // Twice as fast: every other keyframe of the slower one lies between two.
  const TraverseMap map{0, 2, 4, 6, std::nullopt, 10};
  const TraverseMap inverse = inverse_map(map, 13);
  EXPECT_THAT(inverse, ElementsAre(0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, std::nullopt, std::nullopt));
  EXPECT_THAT(inverse_map({}, 2), ElementsAre(std::nullopt, std::nullopt));
  EXPECT_THAT(inverse_map(map, 0), IsEmpty());
}

TEST(FuseTraverses, IsTheMeanLikelihoodOfAPlace) {
  CostMatrix base = chance_costs(12, 9, 1);
  const CostMatrix other = chance_costs(12, 7, 2), third = chance_costs(12, 9, 3);
  const TraverseMap onto_other{std::nullopt, 0, 0.5, 1, 2, 3, 4.25, 6, std::nullopt};
  TraverseMap onto_third(9);
  onto_third[4] = 8;
  CostMatrix expected = base;
  for (std::size_t q = 0; q < 12; ++q) {
    for (std::size_t r = 0; r < 9; ++r) {
      double likelihood = std::exp(-static_cast<double>(base.at(q, r)));
      int count = 1;
      if (onto_other[r]) {
        const auto low = static_cast<std::size_t>(std::floor(*onto_other[r]));
        const auto high = static_cast<std::size_t>(std::ceil(*onto_other[r]));
        likelihood += std::exp(-static_cast<double>(std::min(other.at(q, low), other.at(q, high))));
        ++count;
      }
      if (onto_third[r]) {
        likelihood += std::exp(-static_cast<double>(third.at(q, 8)));
        ++count;
      }
      expected.row(q)[r] = static_cast<float>(-std::log(likelihood / count));
    }
  }
  place::enhance_contrast(expected, {});
  fuse_traverses(base, std::vector<FurtherCosts>{{&other, &onto_other}, {&third, &onto_third}});
  EXPECT_EQ(base.values, expected.values);
}

TEST(FuseTraverses, FindsAWalkOfWhichEachTraverseShowsAHalf) {
  // The base is alike for the first thirty queries, the other for the last thirty.
  constexpr std::size_t kQueries = 60, kPlaces = 100;
  CostMatrix base = walked_costs(kQueries, kPlaces, 20, 1, 3.0F, 4),
             other = chance_costs(kQueries, kPlaces, 5);
  const CostMatrix noise = chance_costs(kQueries, kPlaces, 6);
  TraverseMap map(kPlaces);
  for (std::size_t r = 0; r < kPlaces; ++r) map[r] = static_cast<double>(r);
  for (std::size_t q = 30; q < kQueries; ++q) {
    std::ranges::copy(noise.row(q), base.row(q).begin());
    other.row(q)[q + 20] -= 3;
  }
  const auto right = [&](const CostMatrix& costs) {
    std::size_t count = 0;
    const auto matches = place::search_sequences(costs, {.length = 5});
    for (std::size_t q = 0; q < kQueries; ++q)
      count += static_cast<std::size_t>(matches[q].reference == q + 20);
    return count;
  };
  const std::size_t alone = std::max(right(base), right(other));
  EXPECT_LE(alone, 40U);  // a half, and some by chance
  fuse_traverses(base, std::vector<FurtherCosts>{{&other, &map}});
  EXPECT_GE(right(base), 54U);
}

TEST(FuseTraverses, LeavesABaseThatSharesNoPlaceAsItIs) {
  const CostMatrix before = chance_costs(5, 6, 7), other = chance_costs(5, 4, 8);
  CostMatrix base = before;
  const TraverseMap nowhere(6);
  fuse_traverses(base, {});
  fuse_traverses(base, std::vector<FurtherCosts>{{&other, &nowhere}});
  EXPECT_EQ(base.values, before.values);
  CostMatrix nothing;
  fuse_traverses(nothing, {});
  EXPECT_THAT(nothing.values, IsEmpty());
}

TEST(FuseTraverses, RefusesWhatDoesNotBelongTogether) {
  CostMatrix base = chance_costs(5, 6, 7);
  const CostMatrix other = chance_costs(5, 4, 8), short_one = chance_costs(4, 4, 8);
  const TraverseMap small(5), past{std::nullopt, std::nullopt, std::nullopt, std::nullopt, std::nullopt, 3.5};
  const TraverseMap fitting(6);
  EXPECT_THROW(fuse_traverses(base, std::vector<FurtherCosts>{{&other, &small}}), std::invalid_argument);
  EXPECT_THROW(fuse_traverses(base, std::vector<FurtherCosts>{{&other, &past}}), std::invalid_argument);
  EXPECT_THROW(fuse_traverses(base, std::vector<FurtherCosts>{{&short_one, &fitting}}),
               std::invalid_argument);
}

}  // namespace
