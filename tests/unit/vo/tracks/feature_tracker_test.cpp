#include "support/random_images.hpp"

#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/tracks/feature_tracker.hpp>

namespace {

constexpr int kWidth = 320, kHeight = 240;

/// Frames of a picture that turns about its middle by `degrees` each, clockwise as seen, and moves `shift_px`
/// to the right.
std::vector<cv::Mat> turning(int frames, double degrees, double shift_px) {
  cv::Mat picture(3 * kHeight, 3 * kWidth, CV_8UC1);
  cv::theRNG().state = 7;
  cv::randu(picture, 0, 256);
  cv::GaussianBlur(picture, picture, {}, 4);
  cv::normalize(picture, picture, 0, 255, cv::NORM_MINMAX);
  std::vector<cv::Mat> result;
  for (int i = 0; i < frames; ++i) {
    // OpenCV's angle is counter-clockwise.
    cv::Mat map = cv::getRotationMatrix2D({1.5F * kWidth, 1.5F * kHeight}, -degrees * i, 1);
    map.at<double>(0, 2) += shift_px * i - kWidth;
    map.at<double>(1, 2) -= kHeight;
    cv::warpAffine(picture, result.emplace_back(), map, {kWidth, kHeight}, cv::INTER_CUBIC);
  }
  return result;
}

std::vector<vo::FrameMotion> track(const std::vector<cv::Mat>& frames, std::size_t batch,
                                   const vo::FeatureTrackerOptions& options = {}) {
  vo::FeatureTracker tracker(options);
  std::vector<vo::FrameMotion> all;
  for (std::size_t i = 0; i < frames.size(); i += batch) {
    const auto part = std::span(frames).subspan(i, std::min(batch, frames.size() - i));
    for (const vo::FrameMotion& motion : tracker.push(part)) all.push_back(motion);
  }
  return all;
}

TEST(FeatureTracker, FollowsRotationAndShift) {
  const auto motion = track(turning(8, 0.6, -1.5), 8);
  ASSERT_EQ(motion.size(), 8U);
  EXPECT_FALSE(motion[0].orientation_deg);
  for (std::size_t i = 1; i < motion.size(); ++i) {
    EXPECT_GT(motion[i].matches, 50U);
    EXPECT_NEAR(motion[i].orientation_deg.value(), 0.6, 0.1);  // what SURF's orientations are held to
    EXPECT_NEAR(motion[i].shift_px.value(), -1.5, 0.2);  // points left and right of the middle cancel out
  }
}

TEST(FeatureTracker, GivesTheSameForAnyBatchesAndThreads) {
  const auto frames = turning(7, 1, 2);
  const auto once = track(frames, 7);
  for (const int threads : {1, 3}) {
    vo::set_thread_count(threads);
    const auto again = track(frames, 2);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(again[i].matches, once[i].matches);
      EXPECT_EQ(again[i].orientation_deg, once[i].orientation_deg);
      EXPECT_EQ(again[i].shift_px, once[i].shift_px);
    }
  }
  vo::set_thread_count(0);
}

TEST(FeatureTracker, ResizesWideFrames) {
  const auto frames = turning(4, 0, 4);
  const auto motion = track(frames, 4, {.width_px = kWidth / 2});
  EXPECT_NEAR(motion[3].shift_px.value(), 2, 0.2);  // in pixels of what it worked on
}

TEST(FeatureTracker, SeesNothingOnABlankWall) {
  const std::vector<cv::Mat> wall(4, cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(200, 210, 190)));
  for (const vo::FrameMotion& motion : track(wall, 4)) {
    EXPECT_EQ(motion.matches, 0U);
    EXPECT_FALSE(motion.orientation_deg);
  }
  EXPECT_TRUE(vo::FeatureTracker().push({}).empty());
}

TEST(FeatureTracker, RefusesWhatDoesNotFit) {
  EXPECT_THROW(vo::FeatureTracker({.width_px = 0}), std::invalid_argument);
  EXPECT_THROW(vo::FeatureTracker({.window = 6}), std::invalid_argument);
  vo::FeatureTrackerOptions options;
  options.camera = vo::camera_from_fov(640, 640, 60);
  EXPECT_THROW(track(turning(1, 0, 0), 1, options), vo::Error);  // a calibration of another shape
}

}  // namespace
