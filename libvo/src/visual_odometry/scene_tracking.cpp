#include "vo/visual_odometry/scene_tracking.hpp"

#include "vo/base/median.hpp"
#include "vo/visual_odometry/keyframe_heights.hpp"
#include "vo/visual_odometry/landmark_tracking.hpp"

namespace vo {
namespace {

constexpr std::size_t kRemembered = 25;  // frames whose speeds the next may not exceed by much

/// How many frames ago the last one was.
std::size_t frames_since(const TrackedScene& scene, std::size_t frame) {
  return frame - scene.frames.back().frame;
}

/// True if no camera moves this much in that many frames.
bool is_jump(const TrackedScene& scene, const Pose3& to, std::size_t frames,
             const SceneTrackingOptions& options) {
  const auto count = static_cast<double>(frames);
  const Pose3 motion = compose(inverse(scene.pose), to);
  if (angle_rad(motion.rotation) > count * options.max_turn_rad) return true;
  constexpr double kSmall = 0.1;  // of the median depth: allows a start from rest
  const double displacement = cv::norm(motion.position) / count;
  return scene.speeds.size() >= kRemembered / 2 && displacement > kSmall * scene.median_depth &&
         displacement > options.max_speedup * median(scene.speeds);
}

/// Finds the heights of the keyframes that are now far behind the camera or about to leave the window, or of
/// all that are left.
void measure_heights(TrackedScene& scene, bool all, const SceneTrackingOptions& options) {
  // Of the median depth: bounce and sway hardly change the direction over a long distance. In a scene that is
  // soon lost it may be a few degrees off, which is better than no height at all.
  constexpr double kLongWay = 0.5, kLeastTravel = 0.25;
  const double enough = kLongWay * scene.median_depth;
  const std::vector<Keyframe>& keyframes = scene.map.keyframes;
  while (scene.heights.size() < keyframes.size()) {
    const std::size_t keyframe = scene.heights.size();
    const double gone = cv::norm(scene.pose.position - keyframes[keyframe].pose.position);
    if (!all && gone < enough && keyframe + options.map.window > keyframes.size()) break;
    const cv::Vec3d travelled = direction_at(scene.map, keyframe, enough);
    scene.heights.emplace_back();
    if (cv::norm(travelled) >= kLeastTravel * scene.median_depth)
      scene.heights.back() = keyframe_heights(scene.map, keyframe, travelled, options.ground);
  }
}

void make_keyframe(TrackedScene& scene, const SceneTrackingOptions& options) {
  LandmarkMap& map = scene.map;
  const std::size_t last = map.keyframes.size() - 1;
  const Pose3 new_from_last = compose(inverse(scene.pose), map.keyframes[last].pose);
  for (auto frame = scene.frames.rbegin(); frame != scene.frames.rend(); ++frame) {
    if (frame->frame <= map.keyframes[last].frame) break;
    if (frame->before)
      frame->after = AnchoredPose{last + 1, compose(new_from_last, frame->before->in_keyframe)};
  }
  scene.frames.back().before = AnchoredPose{last + 1, {}};
  scene.frames.back().after.reset();
  add_keyframe(map, {scene.frames.back().frame, scene.pose});
  place_landmarks(map, options.map);
  adjust_window(map, options.map);
  scene.pose = map.keyframes.back().pose;
  measure_heights(scene, false, options);
}

}  // namespace

LandmarkPose locate(TrackedScene& scene, std::size_t frame, const KltPyramid& last, const KltPyramid& next,
                    const Camera& camera, const SceneTrackingOptions& options) {
  const std::vector<Landmark> before = scene.map.landmarks;
  const std::size_t frames = frames_since(scene, frame);
  Pose3 predicted = scene.pose;
  for (std::size_t i = 0; i < frames; ++i) predicted = compose(predicted, scene.motion);
  follow_landmarks(scene.map, last, next, camera, predicted, options.klt);
  LandmarkPose pose = pose_by_landmarks(scene.map, predicted, next[0].size(), options.pose);
  if (pose.loss == TrackLoss::kNone && is_jump(scene, pose.found.camera, frames, options))
    pose.loss = TrackLoss::kJump;
  if (pose.loss != TrackLoss::kNone) scene.map.landmarks = before;
  return pose;
}

void add_frame(TrackedScene& scene, std::size_t frame, const Resection& found, const cv::Mat& grey,
               const Camera& camera, const SceneTrackingOptions& options) {
  const std::size_t frames = frames_since(scene, frame);
  const Pose3 motion = compose(inverse(scene.pose), found.camera);
  for (std::size_t i = frame - frames + 1; i < frame; ++i) scene.frames.push_back({.frame = i});
  scene.motion = interpolate({}, motion, 1 / static_cast<double>(frames));
  scene.pose = found.camera;
  scene.speeds.push_back(cv::norm(scene.motion.position));
  if (scene.speeds.size() > kRemembered) scene.speeds.erase(scene.speeds.begin());

  const std::size_t last = scene.map.keyframes.size() - 1;
  const Pose3& keyframe = scene.map.keyframes[last].pose;
  scene.frames.push_back({.frame = frame,
                          .before = AnchoredPose{last, compose(inverse(keyframe), scene.pose)},
                          .sigma = displacement_sigma(found, scene.pose.rotation * motion.position)});
  const bool moved_on =
      cv::norm(scene.pose.position - keyframe.position) > options.keyframe_travel * scene.median_depth;
  const bool sees_little = static_cast<double>(found.inliers) <
                           options.keyframe_share * static_cast<double>(scene.keyframe_landmarks);
  if (!moved_on && !sees_little) return;
  make_keyframe(scene, options);
  renew_landmarks(scene, grey, camera, options);
}

void renew_landmarks(TrackedScene& scene, const cv::Mat& grey, const Camera& camera,
                     const SceneTrackingOptions& options) {
  prune(scene.map, options.map);
  std::vector<double> depths;
  for (const Landmark& landmark : scene.map.landmarks) {
    if (landmark.followed && landmark.position)
      depths.push_back((scene.pose.rotation.t() * (*landmark.position - scene.pose.position))[2]);
  }
  scene.keyframe_landmarks = depths.size();
  if (!depths.empty()) scene.median_depth = median(depths);
  add_corners(scene.map, grey, camera, options.corners);
}

void finish_heights(TrackedScene& scene, const SceneTrackingOptions& options) {
  measure_heights(scene, true, options);
}

bool is_still(const TrackedScene& scene) {
  constexpr double kStill = 1e-3;  // of the median depth, per frame: a centimetre at 10 m
  return !scene.speeds.empty() && median(scene.speeds) < kStill * scene.median_depth;
}

}  // namespace vo
