#include "vo/tracks/feature_tracker.hpp"

#include "vo/base/parallel.hpp"
#include "vo/image/grey.hpp"

#include <stdexcept>
#include <utility>

namespace vo {
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
  if (!camera_) {
    const cv::Size size = frames.front().size();
    const Camera camera = camera_of_recording(options_.camera, size.width, size.height, options_.fov_deg);
    camera_ = resized(camera, std::min(size.width, options_.width_px));
  }

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
