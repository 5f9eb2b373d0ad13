#include "simulate/simulator.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vo/base/parallel.hpp>

namespace simulate {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Options short_walk(Scene scene, Condition condition) {
  Options options;
  options.scene = scene;
  options.condition = condition;
  options.length_m = 6;
  options.size = {160, 90};
  return options;
}

TEST(WalkSimulator, DrawsTheSameBytesForAnyThreads) {
  Options options = short_walk(Scene::kCorridor, Condition::kNight);
  options.people = 2;
  vo::set_thread_count(1);
  const WalkSimulator one(options);
  const cv::Mat by_one = one.render(30);
  vo::set_thread_count(3);
  const WalkSimulator many(options);
  const cv::Mat by_many = many.render(30);
  vo::set_thread_count(0);
  EXPECT_EQ(cv::norm(by_one, by_many, cv::NORM_INF), 0);
  ASSERT_EQ(one.frame_count(), many.frame_count());
  EXPECT_EQ(one.truth(30).x_m, many.truth(30).x_m);
  EXPECT_EQ(one.truth(30).heading_deg, many.truth(30).heading_deg);
  EXPECT_THROW((void)one.truth(-1), std::out_of_range);
  EXPECT_THROW((void)one.render(one.frame_count()), std::out_of_range);
}

// The middle of what is magenta in a picture, in pixels.
Eigen::Vector2d magenta_centre(const cv::Mat& image) {
  cv::Mat mask;
  cv::inRange(image, cv::Scalar(200, 0, 200), cv::Scalar(255, 60, 255), mask);
  const cv::Moments moments = cv::moments(mask, true);
  EXPECT_GT(moments.m00, 30) << "the target is not in sight";
  return {moments.m10 / moments.m00 + 0.5, moments.m01 / moments.m00 + 0.5};
}

// A magenta square of 0.3 m with this centre, upright, facing south.
Surface magenta_target(const Eigen::Vector3d& centre) {
  constexpr double kSide_m = 0.3;
  return {centre + Eigen::Vector3d(-kSide_m / 2, 0, kSide_m / 2),
          {kSide_m, 0, 0},
          {0, 0, -kSide_m},
          std::make_shared<const Texture>(cv::Mat(8, 8, CV_8UC4, cv::Scalar(255, 0, 255, 255))),
          1};
}

const Eigen::Vector3d kTarget(0.3, 11, 1.5);

// A street with the target in sight, walked with a steadied camera: the body's pose is the camera's but for
// how it is mounted. Built once, for it takes a second.
const WalkSimulator& steady_street() {
  static const WalkSimulator walk = [] {
    Options options = short_walk(Scene::kStreet, Condition::kDay);
    options.size = {640, 360};
    options.swing = 0;
    WalkSimulator street(options);
    street.place(magenta_target(kTarget));
    return street;
  }();
  return walk;
}

TEST(WalkSimulator, TruthAgreesWithThePixels) {
  const WalkSimulator& still = steady_street();
  const Eigen::Vector3d& target = kTarget;
  const Walker walker = draw_walker(still.options().gait_seed);
  const double focal_px = 320 / std::tan(64.4 / 2 * kDegree);
  for (const int frame : {0, 50, still.frame_count() - 1}) {
    const TruthRow truth = still.truth(frame);
    // Written out here, from the truth alone: into the body's frame, then pitch, then roll.
    const double h = truth.heading_deg * kDegree, p = walker.mount_pitch_rad, r = walker.mount_roll_rad;
    const double east = target.x() - truth.x_m, north = target.y() - truth.y_m,
                 up = target.z() - walker.camera_height_m;
    const double ahead = east * std::sin(h) + north * std::cos(h),
                 right = east * std::cos(h) - north * std::sin(h);
    const double z = ahead * std::cos(p) + up * std::sin(p), down = ahead * std::sin(p) - up * std::cos(p);
    const double x = right * std::cos(r) + down * std::sin(r), y = down * std::cos(r) - right * std::sin(r);
    const Eigen::Vector2d found = magenta_centre(still.render(frame));
    // A square of 14 px or more, whose edges may together be off by half a pixel.
    EXPECT_NEAR(found.x(), 320 + focal_px * x / z, 0.6) << frame;
    EXPECT_NEAR(found.y(), 180 + focal_px * y / z, 0.6) << frame;
  }
}

TEST(WalkSimulator, CameraAgreesWithThePixelsAndSwingsAboutTheTruth) {
  Options options = short_walk(Scene::kCorridor, Condition::kDay);
  options.size = {640, 360};
  options.length_m = 8;
  WalkSimulator walk(options);
  const Eigen::Vector3d target(0.2, 12, 1.4);
  walk.place(magenta_target(target));
  double yaw_sum = 0, yaw_range = 0;
  for (int frame = 0; frame < walk.frame_count(); ++frame) {
    const Camera camera = walk.camera(frame);
    const TruthRow truth = walk.truth(frame);
    const Eigen::Vector3d forward = camera.world_from_camera.linear().col(2);
    const double yaw = std::atan2(forward.x(), forward.y()) - truth.heading_deg * kDegree;
    yaw_sum += yaw;
    yaw_range = std::max(yaw_range, std::abs(yaw));
    // Sway of some centimetres about the body.
    EXPECT_LT(
        (camera.world_from_camera.translation().head<2>() - Eigen::Vector2d(truth.x_m, truth.y_m)).norm(),
        0.05);
    if (frame % 40 != 0) continue;
    const Eigen::Vector2d expected = camera.project(target), found = magenta_centre(walk.render(frame));
    EXPECT_NEAR(found.x(), expected.x(), 0.6);
    EXPECT_NEAR(found.y(), expected.y(), 0.6);
  }
  EXPECT_GT(yaw_range, 0.5 * kDegree);
  // Over some ten steps the swing averages out but for a part of a stride and the slow balance.
  EXPECT_LT(std::abs(yaw_sum / walk.frame_count()), 0.4 * kDegree);
}

TEST(WalkSimulator, StreetIsRichInCorners) {
  cv::Mat grey;
  std::vector<cv::Point2f> corners;
  cv::cvtColor(steady_street().render(20), grey, cv::COLOR_BGR2GRAY);
  cv::goodFeaturesToTrack(grey, corners, 2000, 0.02, 4);
  EXPECT_GT(corners.size(), 300U);  // "hundreds of points on the street"
}

TEST(WalkSimulator, AnotherWalkerSeesTheSameStreet) {
  const WalkSimulator& walk = steady_street();
  Options options = walk.options();
  options.gait_seed = 9;
  options.start_m = 2;
  const WalkSimulator other(options);
  ASSERT_EQ(walk.world().surfaces.size(), other.world().surfaces.size() + 1);  // the target
  for (std::size_t i = 0; i < other.world().surfaces.size(); i += 50) {
    const Surface &a = walk.world().surfaces[i], &b = other.world().surfaces[i];
    EXPECT_EQ(a.corner, b.corner);
    EXPECT_EQ(*a.texture->level(0).texels, *b.texture->level(0).texels);
  }
  EXPECT_DOUBLE_EQ(other.truth(0).distance_m, 2);
  EXPECT_NE(other.camera(0).world_from_camera.translation().z(),
            walk.camera(0).world_from_camera.translation().z());
}

TEST(WalkSimulator, TurnsTheCameraAndNotTheWalker) {
  Options options = short_walk(Scene::kStreet, Condition::kDay);
  options.swing = 0;
  const WalkSimulator straight(options);
  options.camera_yaw_deg = 10;
  const WalkSimulator right(options);
  options.camera_yaw_deg = 0;
  options.camera_pitch_deg = -5;
  const WalkSimulator down(options);
  const auto forward = [](const WalkSimulator& walk) {
    return Eigen::Vector3d(walk.camera(20).world_from_camera.linear().col(2));
  };
  const auto yaw = [&](const WalkSimulator& walk) {
    return std::atan2(forward(walk).x(), forward(walk).y());
  };
  const auto pitch = [&](const WalkSimulator& walk) { return std::asin(forward(walk).z()); };
  EXPECT_NEAR(yaw(right) - yaw(straight), 10 * kDegree, 1e-9);
  EXPECT_NEAR(pitch(right) - pitch(straight), 0, 1e-9);
  EXPECT_NEAR(pitch(down) - pitch(straight), -5 * kDegree, 1e-9);
  EXPECT_EQ(right.truth(20).heading_deg, straight.truth(20).heading_deg);
  EXPECT_EQ(right.truth(20).x_m, straight.truth(20).x_m);
}

}  // namespace
}  // namespace simulate
