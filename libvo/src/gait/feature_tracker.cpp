#include "vo/gait/feature_tracker.hpp"

#include "vo/base/error.hpp"
#include "vo/base/parallel.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

cv::Mat grey_of(const cv::Mat& frame, int width_px) {
  cv::Mat grey = frame;
  if (frame.channels() == 3) cv::cvtColor(frame, grey, cv::COLOR_BGR2GRAY);
  if (grey.cols <= width_px) return grey;
  cv::Mat small;
  const int height_px = static_cast<int>(std::lround(static_cast<double>(grey.rows) * width_px / grey.cols));
  cv::resize(grey, small, {width_px, std::max(1, height_px)}, 0, 0, cv::INTER_AREA);
  return small;
}

Camera camera_of(const cv::Mat& frame, const FeatureTrackerOptions& options) {
  if (!options.camera) return camera_from_fov(frame.cols, frame.rows, options.fov_deg);
  if (options.camera->width_px != frame.cols || options.camera->height_px != frame.rows) {
    throw Error("camera calibration",
                fmt::format("is of {}x{} pixels", options.camera->width_px, options.camera->height_px),
                fmt::format("{}x{}, as the recording", frame.cols, frame.rows));
  }
  return *options.camera;
}

}  // namespace

FeatureTracker::FeatureTracker(const FeatureTrackerOptions& options)
    : options_(options), window_(options.window) {
  if (options.width_px < 1) throw std::invalid_argument("FeatureTracker: width_px must be >= 1");
  if (std::string error;
      !options.surf.detector.is_valid(&error) || !options.motion.heading.is_valid(&error)) {
    throw std::invalid_argument("FeatureTracker: " + error);
  }
}

std::vector<FrameMotion> FeatureTracker::push(std::span<const cv::Mat> frames) {
  if (frames.empty()) return {};
  if (!camera_)
    camera_ = resized(camera_of(frames.front(), options_), std::min(frames.front().cols, options_.width_px));

  std::vector<Features> features(frames.size());
  parallel_for(frames.size(), [&](std::size_t i) {
    features[i] = detect_surf(grey_of(frames[i], options_.width_px), options_.surf);
  });

  std::vector<std::vector<Match>> matches(frames.size());
  parallel_for(frames.size(), [&](std::size_t i) {
    const Features* before = i > 0 ? &features[i - 1] : (before_ ? &*before_ : nullptr);
    if (before != nullptr) matches[i] = match_features(*before, features[i], options_.match);
  });

  std::vector<Tracks> tracks;
  for (std::size_t i = 0; i < frames.size(); ++i)
    tracks.push_back(window_.push(features[i].points, matches[i]));
  before_ = std::move(features.back());

  std::vector<FrameMotion> motion(frames.size());
  parallel_for(frames.size(),
               [&](std::size_t i) { motion[i] = frame_motion(tracks[i], *camera_, options_.motion); });
  return motion;
}

}  // namespace vo
