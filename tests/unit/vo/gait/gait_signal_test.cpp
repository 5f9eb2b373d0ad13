#include "support/tracked_scene.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/clock.hpp>
#include <vo/gait/gait_signal.hpp>

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
const vo::Camera kCamera = vo::camera_from_fov(640, 360, 64.4);

/// Points whose orientations change by these angles, shifted by as many pixels.
vo::Tracks tracks(const std::vector<double>& degrees, int span = 1, double start_deg = 0) {
  vo::Tracks result{.span = span, .points = {}};
  for (const double change : degrees) {
    vo::TrackedPoint point;
    point.from.orientation_rad = static_cast<float>(start_deg / kDegrees);
    point.to.orientation_rad = static_cast<float>(std::remainder(start_deg + change, 360.0) / kDegrees);
    point.to.x_px = static_cast<float>(change);
    result.points.push_back(point);
  }
  return result;
}

const vo::FrameMotionOptions kThree{.min_matches = 3};

TEST(FrameMotion, IsTheMedianOverThePointsForEachFrame) {
  const vo::FrameMotion motion = vo::frame_motion(tracks({6, 3, 90}, 3), kCamera, kThree);
  EXPECT_EQ(motion.matches, 3U);
  EXPECT_NEAR(motion.orientation_deg.value(), 2, 1e-5);  // 6 degrees over three frames
  EXPECT_NEAR(motion.shift_px.value(), 2, 1e-5);
  const vo::FrameMotion mean =
      vo::frame_motion(tracks({6, 3, 0}, 3), kCamera, {.average = vo::Average::kMean, .min_matches = 3});
  EXPECT_NEAR(mean.orientation_deg.value(), 1, 1e-5);
  EXPECT_NEAR(mean.shift_px.value(), 1, 1e-5);
}

TEST(FrameMotion, WrapsAtHalfATurn) {
  // 179 to -179 degrees is a change of 2, not of -358.
  for (const auto average : {vo::Average::kMedian, vo::Average::kMean}) {
    const auto motion =
        vo::frame_motion(tracks({2, 2, 2}, 1, 179), kCamera, {.average = average, .min_matches = 3});
    EXPECT_NEAR(motion.orientation_deg.value(), 2, 1e-4);
  }
}

TEST(FrameMotion, OfTooFewPointsIsNone) {
  for (const vo::Tracks& few : {tracks({}), tracks({1, 1}), tracks({1, 1, 1}, 0)}) {
    const vo::FrameMotion motion = vo::frame_motion(few, kCamera, kThree);
    EXPECT_EQ(motion.matches, few.points.size());
    EXPECT_FALSE(motion.orientation_deg || motion.shift_px || motion.turn);
  }
}

vo::FrameMotion moved(double orientation_deg, double turn_rad) {
  return {
      .matches = 100, .orientation_deg = orientation_deg, .shift_px = 0.0, .turn = vo::Turn{turn_rad, 0, {}}};
}

std::vector<double> times(std::size_t frames) {
  std::vector<double> time_s;
  for (std::size_t i = 0; i < frames; ++i) time_s.push_back(static_cast<double>(i) / 25);
  return time_s;
}

TEST(GaitSignal, BridgesGapsAndCountsThem) {
  std::vector<vo::FrameMotion> motion{{}};  // the first frame has none before it
  for (int i = 1; i < 100; ++i) motion.push_back(moved(0.5, 0.01));
  for (int i = 40; i < 50; ++i) motion[static_cast<std::size_t>(i)] = {};
  const vo::GaitSignal signal = vo::gait_signal(motion, times(100), {.heading_cutoff_hz = 0});
  EXPECT_EQ(signal.bridged, 10U);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(signal.reliable[i], i != 0 && (i < 40 || i >= 50));
    EXPECT_NEAR(signal.orientation.values[i], 0.5, 1e-9);  // constant, so the line and the filter are it
    EXPECT_NEAR(signal.heading_rad[i], 0.01 * static_cast<double>(i), 1e-12);  // the gap turns on
  }
}

TEST(GaitSignal, NamesItsUnits) {
  std::vector<vo::FrameMotion> motion(100, moved(0.5, 0));
  for (vo::FrameMotion& frame : motion) frame.picture = vo::PictureMotion{.growth = 0.004};
  const vo::GaitSignal signal = vo::gait_signal(motion, times(100));
  EXPECT_EQ(vo::name_of(signal.orientation.unit), "deg");
  EXPECT_EQ(vo::name_of(signal.shift.unit), "px");
  EXPECT_EQ(vo::name_of(signal.bounce.unit), "px");
  EXPECT_EQ(signal.rate_hz, vo::frame_rate_hz(signal.time_s));
  for (const double growth_per_s : signal.growth_per_s) EXPECT_NEAR(growth_per_s, 0.1, 1e-9);
  // A degree, or half a pixel, a second.
  EXPECT_DOUBLE_EQ(vo::least_gait(vo::SignalUnit::kDegrees, 25), 0.04);
  EXPECT_DOUBLE_EQ(vo::least_gait(vo::SignalUnit::kPixels, 50), 0.01);
}

TEST(GaitSignal, HeadingIsFreeOfTheSwingAndKeepsTurns) {
  // A quarter turn in four seconds, and a swing of 5 degrees at 0.9 Hz.
  std::vector<vo::FrameMotion> motion;
  std::vector<double> true_rad;
  const auto time_s = times(500);
  const auto walker = [](double t) { return std::clamp((t - 8) / 4, 0.0, 1.0) * std::numbers::pi / 2; };
  const auto camera = [&](double t) {
    return walker(t) + 5 / kDegrees * std::sin(2 * std::numbers::pi * 0.9 * t);
  };
  for (const double t : time_s) {
    motion.push_back(moved(0, camera(t) - camera(t - 1.0 / 25)));
    true_rad.push_back(walker(t));
  }
  const vo::GaitSignal signal = vo::gait_signal(motion, time_s);
  for (std::size_t i = 50; i < 450; ++i) {
    // Order 2 both ways leaves 1 / (1 + 1.8^4) of the swing at 0.9 Hz, 0.4 degrees, and rounds the turn's
    // ends.
    EXPECT_NEAR(signal.heading_rad[i] * kDegrees, true_rad[i] * kDegrees, 3) << i;
  }
  EXPECT_NEAR((signal.heading_rad[400] - signal.heading_rad[100]) * kDegrees, 90, 1.5);
}

TEST(GaitSignal, LearnsWhereTheCameraLooksFromTheWholeWalk) {
  // Worn 6 degrees to the left: the walker goes to the right of where it looks, and does not turn.
  const double side_rad = 6 / kDegrees;
  const test_support::CameraMove step{.travel_m = {0.15 * std::sin(side_rad), 0, 0.15 * std::cos(side_rad)}};
  std::vector<vo::FrameMotion> motion;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const vo::Tracks seen{
        .span = 1,
        .points = test_support::tracked_points(kCamera, step, 150, test_support::anywhere, 0.2, i)};
    motion.push_back(vo::frame_motion(seen, kCamera));
  }
  const vo::GaitSignal signal = vo::gait_signal(motion, times(100));
  EXPECT_NEAR(signal.travel_rad * kDegrees, 6, 0.7);  // the prior about straight ahead draws it in a little
  // Straight ahead taken for granted, the turn would be 0.2 degrees a frame, 20 in all.
  EXPECT_NEAR(signal.heading_rad.back() * kDegrees, 0, 3);
}

TEST(GaitSignal, RefusesWhatItCannotTake) {
  const std::vector<vo::FrameMotion> motion(10, moved(0, 0));
  EXPECT_THROW(vo::gait_signal(motion, times(9)), std::invalid_argument);
  EXPECT_THROW(vo::gait_signal(std::span(motion).first(1), times(1)), std::invalid_argument);
  std::vector<double> slow_s;  // 8 frames/s: a cut-off of 4 Hz is its limit
  for (int i = 0; i < 10; ++i) slow_s.push_back(i / 8.0);
  EXPECT_THROW(vo::gait_signal(motion, slow_s), std::invalid_argument);
}

}  // namespace
