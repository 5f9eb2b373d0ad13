#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"
#include "support/seen_points.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <place/match/view_relation.hpp>

namespace {

using test_support::marked_points;
using test_support::packed_view;
using test_support::point_scene;
using test_support::turned;

constexpr double kNoise = 5e-4;  // a quarter of a pixel at 500 px focal length

vo::ViewPoints view(const vo::Pose3& camera, std::uint64_t descriptors = 1, std::uint64_t noise = 1) {
  return vo::unpack_view_points(
      packed_view(camera, marked_points(point_scene(180), descriptors), kNoise, noise));
}

TEST(ViewRelation, SaysTurnAndDirection) {
  const auto relation = place::relate_views(view({}), view(turned(0.17, {0.6, 0, 0.8}), 1, 2));
  EXPECT_GT(relation.matches, 150U);
  ASSERT_TRUE(relation.turn);
  ASSERT_TRUE(relation.bearing);
  // Of 150 points at a quarter of a pixel the turn is known to a fifth of a degree, the direction to two.
  EXPECT_NEAR(relation.bearing->turn_rad, 0.17, 0.004);
  EXPECT_NEAR(relation.bearing->bearing_rad, std::atan2(0.6, 0.8), 0.035);
}

TEST(ViewRelation, OfACameraThatOnlyTurnedHasNoDirection) {
  const auto relation = place::relate_views(view({}), view(turned(-0.2), 1, 2));
  ASSERT_TRUE(relation.turn);
  EXPECT_NEAR(relation.turn->turn_rad, -0.2, 0.002);
  EXPECT_FALSE(relation.bearing);
}

TEST(ViewRelation, OfAnotherPlaceIsNone) {
  for (std::uint64_t other = 2; other < 8; ++other) {
    const auto relation = place::relate_views(view({}), view(turned(0.1, {0.5, 0, 0.5}), other, 2));
    EXPECT_FALSE(relation.turn && relation.bearing) << other;
  }
  EXPECT_FALSE(place::relate_views({}, view({})).turn);
  EXPECT_FALSE(place::relate_views(view({}), {}).turn);
  EXPECT_EQ(place::relate_views({}, {}).matches, 0U);
}

}  // namespace
