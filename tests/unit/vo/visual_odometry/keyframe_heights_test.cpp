#include "support/rendered_room.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/visual_odometry/keyframe_heights.hpp>

namespace {

using test_support::turned;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

/// Keyframes 2 m apart, along z and then, from the fourth on, along x.
vo::LandmarkMap round_a_corner() {
  vo::LandmarkMap map;
  for (std::size_t i = 0; i < 4; ++i) map.keyframes.push_back({10 * i, turned(0, {0, 0, 2.0 * double(i)})});
  for (std::size_t i = 1; i < 4; ++i)
    map.keyframes.push_back({30 + 10 * i, turned(0, {2.0 * double(i), 0, 6})});
  return map;
}

TEST(WayAt, IsTheOneThatTheCameraWentOn) {
  const vo::LandmarkMap map = round_a_corner();
  EXPECT_EQ(vo::direction_at(map, 0, 3), cv::Vec3d(0, 0, 4));
  EXPECT_EQ(vo::direction_at(map, 3, 3), cv::Vec3d(4, 0, 0));
}

TEST(WayAt, IsTheOneThatItCameWhereItWentNoFurther) {
  const vo::LandmarkMap map = round_a_corner();
  EXPECT_EQ(vo::direction_at(map, 6, 3), cv::Vec3d(4, 0, 0));
  EXPECT_EQ(vo::direction_at(map, 5, 3), cv::Vec3d(4, 0, 0));
}

TEST(WayAt, IsTheLongestWhereNoneIsEnough) {
  const vo::LandmarkMap map = round_a_corner();
  EXPECT_EQ(vo::direction_at(map, 6, 100), cv::Vec3d(6, 0, 6));
  vo::LandmarkMap one;
  one.keyframes.push_back({0, {}});
  EXPECT_EQ(vo::direction_at(one, 0, 1), cv::Vec3d(0, 0, 0));
}

TEST(KeyframeHeights, AreThoseAboveWhatTheKeyframeSaw) {
  vo::LandmarkMap map = round_a_corner();
  const auto add = [&](const cv::Vec3d& position, std::vector<std::size_t> keyframes) {
    vo::Landmark landmark{.followed = false, .sightings = {}, .position = position};
    for (const std::size_t keyframe : keyframes) landmark.sightings.push_back({keyframe, {}});
    map.landmarks.push_back(landmark);
  };
  add({0, 1.5, 5}, {0, 1});  // ground
  add({0, 1.4, 7}, {1, 2});  // and further on
  add({0, 1.3, 5}, {0, 2});  // keyframe 1 did not see it
  add({0, 1.2, 7}, {1});
  map.landmarks.back().position.reset();
  EXPECT_THAT(vo::keyframe_heights(map, 1, {0, 0, 9}),
              ElementsAre(DoubleNear(1.5, 1e-12), DoubleNear(1.4, 1e-12)));
  EXPECT_THAT(vo::keyframe_heights(map, 3, {0, 0, 9}), IsEmpty());
}

}  // namespace
