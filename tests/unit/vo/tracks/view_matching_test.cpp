#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"
#include "support/seen_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/tracks/view_matching.hpp>

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using vo::ViewMatch;
using vo::ViewPoints;

/// Points at the middle whose descriptors are one value and zeros.
ViewPoints points_of(const std::vector<std::int8_t>& values) {
  ViewPoints points;
  for (const std::int8_t value : values) {
    points.azimuth_rad.push_back(0);
    points.elevation_rad.push_back(0);
    points.log2_size.push_back(-6);
    points.laplacian.push_back(1);
    points.descriptors.push_back(value);
    points.descriptors.resize(points.size() * ViewPoints::kValues);
  }
  return points;
}

double distance(const ViewPoints& a, std::size_t i, const ViewPoints& b, std::size_t j) {
  double squared = 0;
  for (std::size_t v = 0; v < ViewPoints::kValues; ++v) {
    const double off = a.descriptor(i)[v] - b.descriptor(j)[v];
    squared += off * off;
  }
  return std::sqrt(squared);
}

/// By the definition, all pairs against all.
std::vector<ViewMatch> brute_force(const ViewPoints& from, const ViewPoints& to,
                                   const vo::ViewMatchOptions& options) {
  const auto may = [&](std::size_t i, std::size_t j) {
    return from.laplacian[i] == to.laplacian[j] &&
           std::abs(from.elevation_rad[i] - to.elevation_rad[j]) <= options.max_elevation_rad &&
           std::abs(from.log2_size[i] - to.log2_size[j]) <= options.max_octaves;
  };
  std::vector<ViewMatch> matches;
  for (std::size_t j = 0; j < to.size(); ++j) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (!may(i, j)) continue;
      double rival = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < from.size(); ++k)
        if (k != i && may(k, j)) rival = std::min(rival, distance(from, k, to, j));
      for (std::size_t k = 0; k < to.size(); ++k)
        if (k != j && may(i, k)) rival = std::min(rival, distance(from, i, to, k));
      const double own = distance(from, i, to, j);
      if (own < rival && own <= options.max_ratio * rival) matches.push_back({i, j});
    }
  }
  return matches;
}

TEST(ViewMatching, PairsEachOthersNearest) {
  // 40 and 41 are near to the 42 of the other view alike, 0 is nobody's.
  EXPECT_THAT(vo::match_views(points_of({10, 40, 41, -30}), points_of({-31, 0, 42, 12})),
              ElementsAre(ViewMatch{3, 0}, ViewMatch{2, 2}, ViewMatch{0, 3}));
  EXPECT_THAT(vo::match_views(points_of({10, 40, 41, -30}), points_of({-31, 0, 42, 12}), {.max_ratio = 0.4}),
              ElementsAre(ViewMatch{3, 0}, ViewMatch{0, 3}));
}

TEST(ViewMatching, LooksAtPointsOfOneKindHeightAndSizeOnly) {
  const ViewPoints from = points_of({10, 40});
  EXPECT_THAT(vo::match_views(from, from), ElementsAre(ViewMatch{0, 0}, ViewMatch{1, 1}));
  ViewPoints to = from;
  to.azimuth_rad[0] = 1.5F;  // any turn
  to.laplacian[1] = -1;
  EXPECT_THAT(vo::match_views(from, to), ElementsAre(ViewMatch{0, 0}));
  to.elevation_rad[0] = 0.13F;
  EXPECT_THAT(vo::match_views(from, to), IsEmpty());
  to.elevation_rad[0] = -0.11F;
  to.log2_size[0] = -6.6F;
  EXPECT_THAT(vo::match_views(from, to), IsEmpty());
}

TEST(ViewMatching, IsThatOfBruteForce) {
  const auto points = test_support::point_scene(120);
  const auto here = test_support::marked_points(points, 1);
  auto there = test_support::marked_points(points, 2);
  for (std::size_t i = 0; i < here.steps.size(); ++i)  // alike to any degree, the later points the more
    if (i % points.size() > 30) there.steps[i] = here.steps[i];
  const ViewPoints from = vo::unpack_view_points(test_support::packed_view({}, here));
  const ViewPoints to = vo::unpack_view_points(
      test_support::packed_view(test_support::turned(0.2, {0.3, 0, 0.5}), there, 1e-3));
  for (const double ratio : {0.7, 0.93, 1.0}) {
    const auto expected = brute_force(from, to, {.max_ratio = ratio});
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(vo::match_views(from, to, {.max_ratio = ratio}), expected) << ratio;
  }
}

TEST(ViewMatching, OfNothingIsNothing) {
  EXPECT_THAT(vo::match_views({}, {}), IsEmpty());
  EXPECT_THAT(vo::match_views(points_of({1}), {}), IsEmpty());
  EXPECT_THAT(vo::match_views({}, points_of({1})), IsEmpty());
  EXPECT_THAT(vo::match_views(points_of({7}), points_of({-7})), ElementsAre(ViewMatch{0, 0}));  // no rival
  EXPECT_THAT(vo::match_views(points_of({5, 5, 5}), points_of({5, 5})), IsEmpty());  // nothing stands out
  EXPECT_THROW(vo::match_views({}, {}, {.max_ratio = 0}), std::invalid_argument);
  EXPECT_THROW(vo::match_views({}, {}, {.max_elevation_rad = -1}), std::invalid_argument);
  EXPECT_THROW(vo::match_views({}, {}, {.max_octaves = std::nan("")}), std::invalid_argument);
}

}  // namespace
