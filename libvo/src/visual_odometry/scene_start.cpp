#include "vo/visual_odometry/scene_start.hpp"

#include "vo/base/median.hpp"
#include "vo/geometry/resection.hpp"
#include "vo/geometry/two_view_geometry.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

namespace vo {
namespace {

/// The pose of a waiting frame; none if it sees too few landmarks.
std::optional<Resection> found_by(const WaitingFrame& frame, const LandmarkMap& map, const Pose3& start,
                                  const LandmarkMapOptions& map_options, const SceneStartOptions& options) {
  std::vector<cv::Vec3d> points;
  std::vector<ImagePoint> seen;
  for (const WaitingFrame::Seen& one : frame.seen) {
    const std::optional<cv::Vec3d>& position = map.landmarks[one.landmark].position;
    if (!position) continue;
    points.push_back(*position);
    seen.push_back(one.at);
  }
  const Resection found = resection(points, seen, start, {.noise = map_options.noise, .seed = options.seed});
  if (found.inliers < options.min_seen) return std::nullopt;
  return found;
}

}  // namespace

WaitingFrame waiting_frame(const LandmarkMap& map, std::size_t frame, double noise) {
  WaitingFrame waiting{.frame = frame};
  std::vector<ImagePoint> from, to;
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    const Landmark& landmark = map.landmarks[i];
    if (!landmark.followed) continue;
    waiting.seen.push_back({i, landmark.at});
    from.push_back(landmark.sightings[0].at);
    to.push_back(landmark.at);
  }
  const ViewRotation turned = view_rotation(from, to, noise);
  waiting.rotation = turned.rotation;
  waiting.off = median(turned.off);
  return waiting;
}

std::vector<SegmentFrame> begin_scene(LandmarkMap& map, const std::vector<WaitingFrame>& waiting,
                                      const LandmarkMapOptions& map_options,
                                      const SceneStartOptions& options) {
  const WaitingFrame& last = waiting.back();
  std::vector<ImagePoint> from, to;
  for (const WaitingFrame::Seen& one : last.seen) {
    from.push_back(map.landmarks[one.landmark].sightings[0].at);
    to.push_back(one.at);
  }
  const std::optional<TwoViewGeometry> geometry = two_view_geometry(
      from, to, {.noise = map_options.noise, .min_inliers = options.min_landmarks, .seed = options.seed});
  if (!geometry || geometry->parallax_rad < options.min_parallax_rad) return {};
  std::vector<double> depths;
  for (const std::optional<cv::Vec3d>& point : geometry->points) {
    if (point) depths.push_back((*point)[2]);
  }
  const double unit = median(depths);
  for (std::size_t i = 0; i < last.seen.size(); ++i) {
    if (geometry->points[i]) map.landmarks[last.seen[i].landmark].position = *geometry->points[i] / unit;
  }
  add_keyframe(map, {last.frame, {geometry->second.rotation, geometry->second.position / unit}});
  adjust_window(map, map_options);

  std::vector<SegmentFrame> segment{{.frame = map.keyframes[0].frame, .before = AnchoredPose{0, {}}}};
  const Pose3 last_from_first = inverse(map.keyframes[1].pose);
  Pose3 pose;
  for (std::size_t i = 0; i + 1 < waiting.size(); ++i) {
    SegmentFrame frame{.frame = waiting[i].frame};
    if (const auto found = found_by(waiting[i], map, pose, map_options, options)) {
      frame.sigma = displacement_sigma(*found, found->camera.position - pose.position);
      pose = found->camera;
      frame.before = AnchoredPose{0, pose};
      frame.after = AnchoredPose{1, compose(last_from_first, pose)};
    }
    segment.push_back(frame);
  }
  const double sigma = segment.back().sigma;  // adjusting the keyframe hardly changed it
  segment.push_back({.frame = last.frame, .before = AnchoredPose{1, {}}, .sigma = sigma});
  return segment;
}

bool stood_or_turned(const std::vector<WaitingFrame>& waiting, double seconds, double noise) {
  constexpr double kLeastSeconds = 0.5, kLeastTurn_rad = std::numbers::pi / 18;
  // Cameras are known to a few per cent, and the error looks like motion in a turn.
  constexpr double kShareOfTurn = 0.02;
  if (waiting.empty()) return false;
  const double turn_rad = angle_rad(waiting.back().rotation);
  return waiting.back().off <= 2 * noise + kShareOfTurn * turn_rad &&
         (seconds >= kLeastSeconds || turn_rad >= kLeastTurn_rad);
}

}  // namespace vo
