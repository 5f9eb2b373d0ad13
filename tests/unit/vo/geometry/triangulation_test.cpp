#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"

#include <array>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace {

using test_support::turned;

TEST(Triangulation, FindsThePointThatBothSee) {
  // From (0, 0, 0) it is straight ahead; from (1, 0, 0), turned 45 degrees to the left, as well: (0, 0, 1).
  const std::array<vo::Pose3, 2> cameras{vo::Pose3{}, turned(-std::numbers::pi / 4, {1, 0, 0})};
  const auto point = vo::triangulate(cameras, std::array{vo::ImagePoint{0, 0}, vo::ImagePoint{0, 0}});
  ASSERT_TRUE(point);
  EXPECT_LT(cv::norm(*point - cv::Vec3d(0, 0, 1)), 1e-12);
}

TEST(Triangulation, UndoesProjectionForAnyNumberOfViews) {
  std::vector<vo::Pose3> cameras;
  for (int i = 0; i < 5; ++i) cameras.push_back(turned(0.1 * i, {0.4 * i, -0.1 * i, 0.2 * i}));
  for (const cv::Vec3d& point : test_support::point_scene(50)) {
    std::vector<vo::ImagePoint> seen;
    for (const vo::Pose3& camera : cameras) seen.push_back(*vo::project(camera, point));
    EXPECT_LT(cv::norm(vo::triangulate(cameras, seen).value() - point), 1e-8);
  }
}

TEST(Triangulation, HasNoAnswerForParallelRaysOrPointsBehind) {
  const std::array<vo::Pose3, 2> cameras{vo::Pose3{}, turned(0, {1, 0, 0})};
  EXPECT_FALSE(vo::triangulate(cameras, std::array{vo::ImagePoint{0, 0}, vo::ImagePoint{0, 0}}));
  EXPECT_FALSE(
      vo::triangulate(cameras, std::array{vo::ImagePoint{0, 0}, vo::ImagePoint{0.5, 0}}));  // they part
  EXPECT_FALSE(vo::project({}, {0, 0, -1}));
  EXPECT_THROW(vo::triangulate({}, {}), std::invalid_argument);
  EXPECT_THROW(vo::triangulate(cameras, std::array{vo::ImagePoint{0, 0}}), std::invalid_argument);
}

TEST(Triangulation, AngleBetweenRays) {
  EXPECT_NEAR(vo::angle_between_rad({0, 0, 1}, {0, 1, 0}), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(vo::angle_between_rad({0, 0, 1}, cv::normalize(cv::Vec3d(1e-6, 0, 1))), 1e-6, 1e-12);
  EXPECT_NEAR(cv::norm(vo::ray_of({}, {3, 4})), 1, 1e-12);
}

}  // namespace
