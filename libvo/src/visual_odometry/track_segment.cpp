#include "vo/visual_odometry/track_segment.hpp"

#include <cmath>

namespace vo {
namespace {

std::optional<Pose3> pose_of(const SegmentFrame& frame, const std::vector<Keyframe>& keyframes) {
  if (!frame.before) return std::nullopt;
  const Keyframe& before = keyframes[frame.before->keyframe];
  const Pose3 pose = compose(before.pose, frame.before->in_keyframe);
  if (!frame.after) return pose;
  const Keyframe& after = keyframes[frame.after->keyframe];
  const double share =
      static_cast<double>(frame.frame - before.frame) / static_cast<double>(after.frame - before.frame);
  return interpolate(pose, compose(after.pose, frame.after->in_keyframe), share);
}

}  // namespace

double heading_change_rad(const cv::Matx33d& from, const cv::Matx33d& to) {
  const cv::Matx33d turn = from.t() * to;
  return std::atan2(turn(0, 2), turn(2, 2));  // the second's view direction in the first's axes
}

void write_segment(std::span<const SegmentFrame> frames, const std::vector<Keyframe>& keyframes, int segment,
                   DisplacementTrack& track) {
  std::optional<Pose3> before;
  for (const SegmentFrame& frame : frames) {
    const std::optional<Pose3> pose = pose_of(frame, keyframes);
    TrackedDisplacement& result = track.frames[frame.frame];
    const bool first = &frame == &frames.front();
    if (!first) {
      const TrackLoss loss = result.loss == TrackLoss::kNone ? TrackLoss::kTooFewInliers : result.loss;
      result = {.valid = pose && before, .segment = segment};
      if (result.valid) {
        result.displacement = cv::norm(pose->position - before->position);
        result.sigma = frame.sigma;
        result.turn_rad = heading_change_rad(before->rotation, pose->rotation);
      } else {
        result.loss = loss;
      }
    } else if (!result.valid) {
      result.segment = segment;
    }
    if (!first || !track.poses[frame.frame]) track.poses[frame.frame] = pose;
    before = pose;
  }
}

}  // namespace vo
