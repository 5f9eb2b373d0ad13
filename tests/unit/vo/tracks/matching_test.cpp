#include "support/blob_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>
#include <vo/surf/surf.hpp>
#include <vo/tracks/matching.hpp>

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using vo::Match;

/// Points of two values each; what is not given is alike.
vo::Features features_of(const std::vector<std::array<float, 2>>& rows) {
  vo::Features features{.descriptor_size = 2};
  for (const auto& row : rows) {
    features.points.push_back({});
    features.descriptors.insert(features.descriptors.end(), row.begin(), row.end());
  }
  return features;
}

/// Random unit vectors at random places, about half of them of either sign.
vo::Features random_features(std::size_t count, std::uint64_t seed) {
  vo::Rng rng(seed);
  vo::Features features{.descriptor_size = 64};
  for (std::size_t i = 0; i < count; ++i) {
    features.points.push_back({.x_px = static_cast<float>(rng.uniform(0, 300)),
                               .y_px = static_cast<float>(rng.uniform(0, 200)),
                               .laplacian = static_cast<std::int8_t>(rng.index(2) == 0 ? 1 : -1)});
    std::array<double, 64> values;
    double squared = 0;
    for (double& value : values) {
      value = rng.normal();
      squared += value * value;
    }
    for (const double value : values)
      features.descriptors.push_back(static_cast<float>(value / std::sqrt(squared)));
  }
  return features;
}

/// The same points with noise on places and descriptors, in another order.
vo::Features disturbed(const vo::Features& features, double noise, std::uint64_t seed) {
  vo::Rng rng(seed);
  vo::Features result = features;
  std::ranges::reverse(result.points);
  for (auto& point : result.points) point.x_px += static_cast<float>(rng.uniform(-5, 5));
  for (std::size_t i = 0; i < features.size(); ++i) {
    for (std::size_t k = 0; k < 64; ++k) {
      result.descriptors[i * 64 + k] =
          features.descriptors[(features.size() - 1 - i) * 64 + k] + static_cast<float>(noise * rng.normal());
    }
  }
  return result;
}

/// Every pair in double precision, by what the header says.
std::vector<Match> brute_force(const vo::Features& from, const vo::Features& to,
                               const vo::MatchOptions& options) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const auto distance = [&](std::size_t i, std::size_t j) {
    const auto &a = from.points[i], &b = to.points[j];
    if (a.laplacian != b.laplacian) return kFar;
    if (options.max_displacement_px > 0 &&
        std::hypot(a.x_px - b.x_px, a.y_px - b.y_px) > options.max_displacement_px)
      return kFar;
    double squared = 0;
    for (std::size_t k = 0; k < from.descriptor_size; ++k)
      squared += std::pow(static_cast<double>(from.descriptor(i)[k]) - to.descriptor(j)[k], 2);
    return std::sqrt(squared);
  };
  std::vector<Match> matches;
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> row;
    for (std::size_t j = 0; j < to.size(); ++j) row.emplace_back(distance(i, j), j);
    std::ranges::sort(row);
    const auto [first, j] = row[0];
    if (first == kFar ||
        (options.max_ratio < 1 && row.size() > 1 && first > options.max_ratio * row[1].first))
      continue;
    bool mutual = true;
    for (std::size_t rival = 0; rival < from.size(); ++rival) mutual = mutual && distance(rival, j) >= first;
    if (mutual || !options.mutual) matches.push_back({i, j, static_cast<float>(first)});
  }
  return matches;
}

void expect_same(const std::vector<Match>& matches, const std::vector<Match>& expected) {
  ASSERT_EQ(matches.size(), expected.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    EXPECT_EQ(matches[i].from, expected[i].from);
    EXPECT_EQ(matches[i].to, expected[i].to);
    // 2 - 2 q.r in floats of 6e-8: up to 64 roundings of about 1, 4e-6 of a squared distance of 0.03 or more.
    EXPECT_NEAR(matches[i].distance, expected[i].distance, 2e-5);
  }
}

TEST(Matching, WorkedExample) {
  const auto from = features_of({{0, 0}, {10, 0}, {20, 0}});
  const auto to = features_of({{10, 1}, {0, 3}, {0, 4}, {21, 0}});
  // (0, 0) is 3 and 4 from its nearest: a ratio of 0.75.
  EXPECT_THAT(vo::match_features(from, to, {.max_ratio = 0.8}),
              ElementsAre(Match{0, 1, 3}, Match{1, 0, 1}, Match{2, 3, 1}));
  EXPECT_THAT(vo::match_features(from, to, {.max_ratio = 0.7}), ElementsAre(Match{1, 0, 1}, Match{2, 3, 1}));
}

TEST(Matching, MutualLeavesTheNearerOfTwoRivals) {
  const auto from = features_of({{0, 2}, {0, 1}}), to = features_of({{0, 0}});
  EXPECT_THAT(vo::match_features(from, to, {.mutual = true}), ElementsAre(Match{1, 0, 1}));
  EXPECT_THAT(vo::match_features(from, to, {.mutual = false}), ElementsAre(Match{0, 0, 2}, Match{1, 0, 1}));
}

TEST(Matching, OfEqualDistancesTheLowestIndexWins) {
  // The first on the list lies lowest in the image, so that it is searched last.
  auto from = features_of({{0, 1}, {0, 1}});
  auto to = features_of({{0, 0}, {0, 0}});
  from.points[0].y_px = to.points[0].y_px = 100;
  EXPECT_THAT(vo::match_features(from, to, {.max_ratio = 1}), ElementsAre(Match{0, 0, 1}));
  EXPECT_THAT(vo::match_features(from, to, {.max_ratio = 1, .mutual = false}),
              ElementsAre(Match{0, 0, 1}, Match{1, 0, 1}));
  EXPECT_THAT(vo::match_features(from, to, {.max_ratio = 0.99}), IsEmpty());
}

TEST(Matching, OnlyPointsOfOneSignMatch) {
  auto from = features_of({{0, 0}, {5, 0}}), to = features_of({{0, 0}, {6, 0}});
  from.points[0].laplacian = -1;
  EXPECT_THAT(vo::match_features(from, to, {.max_ratio = 1}), ElementsAre(Match{1, 1, 1}));
}

TEST(Matching, OnlyPointsWithinReachAreCandidates) {
  auto from = features_of({{0, 0}}), to = features_of({{0, 1}, {0, 2}, {0, 1.5F}});
  to.points[0].x_px = 31;
  to.points[1].x_px = 24;
  to.points[1].y_px = 18;  // 30 away
  to.points[2].y_px = -31;
  // Neither the nearer descriptors nor their ratios count.
  EXPECT_THAT(vo::match_features(from, to, {.max_displacement_px = 30}), ElementsAre(Match{0, 1, 2}));
  EXPECT_THAT(vo::match_features(from, to, {.max_displacement_px = 29.9}), IsEmpty());
}

TEST(Matching, IsExact) {
  const auto from = random_features(203, 1);
  const auto to = disturbed(from, 0.1, 2);
  for (const double ratio : {0.8, 1.0}) {
    for (const bool mutual : {false, true}) {
      for (const double reach : {0.0, 4.0, 60.0}) {
        const vo::MatchOptions options{.max_ratio = ratio, .mutual = mutual, .max_displacement_px = reach};
        const auto expected = brute_force(from, to, options);
        ASSERT_GT(expected.size(), 20U);
        expect_same(vo::match_features(from, to, options), expected);
      }
    }
  }
}

TEST(Matching, OfAnImageWithItselfIsTheIdentity) {
  const auto features = vo::detect_surf(test_support::BlobScene(200, 150, 100, 1).draw({300, 200}));
  const auto matches = vo::match_features(features, features);
  ASSERT_GE(matches.size(), features.size() * 9 / 10);
  for (const auto& match : matches) {
    EXPECT_EQ(match.from, match.to);
    EXPECT_LE(match.distance, 2e-3F);  // the square root of a few roundings of 1, 6e-8
  }
}

TEST(Matching, IsTheSameForAnyThreadCount) {
  const auto from = random_features(500, 5);
  const auto to = disturbed(from, 0.1, 6);
  vo::set_thread_count(1);
  const auto one = vo::match_features(from, to);
  vo::set_thread_count(4);
  EXPECT_EQ(vo::match_features(from, to), one);
  vo::set_thread_count(0);
}

TEST(Matching, OfEmptyAndSingleInput) {
  const auto none = random_features(0, 1), one = random_features(1, 1), two = random_features(2, 1);
  EXPECT_THAT(vo::match_features(none, two), IsEmpty());
  EXPECT_THAT(vo::match_features(two, none), IsEmpty());
  EXPECT_THAT(vo::match_features({}, one), IsEmpty());
  // A single candidate passes the ratio test.
  EXPECT_EQ(vo::match_features(one, one).size(), 1U);
}

TEST(Matching, RefusesWrongInput) {
  const auto features = random_features(2, 1);
  EXPECT_THROW(vo::match_features(features, features_of({{0, 1}})), std::invalid_argument);
  EXPECT_THROW(vo::match_features(features, features, {.max_ratio = 0}), std::invalid_argument);
  EXPECT_THROW(vo::match_features(features, features, {.max_ratio = 1.1}), std::invalid_argument);
  EXPECT_THROW(vo::match_features(features, features, {.max_displacement_px = -1}), std::invalid_argument);
  EXPECT_THROW(vo::match_features(features, features, {.max_ratio = std::nan("")}), std::invalid_argument);
}

}  // namespace
