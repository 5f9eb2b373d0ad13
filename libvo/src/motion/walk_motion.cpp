#include "vo/motion/walk_motion.hpp"

#include "vo/base/clock.hpp"
#include "vo/base/error.hpp"
#include "vo/gait/lowpass.hpp"
#include "vo/gait/playback.hpp"
#include "vo/gait/thumbnail_motion.hpp"
#include "vo/motion/height_by_steps.hpp"
#include "vo/motion/published_hybrid.hpp"

#include <numeric>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace vo {
namespace {

/// All from one source. The error is that of the test walks, as there are no track and steps to measure it
/// with.
std::vector<FrameDisplacement> from_one(const std::vector<double>& displacement, DisplacementSource source,
                                        double relative_error) {
  std::vector<FrameDisplacement> frames;
  for (const double value : displacement) frames.push_back({value, relative_error * value, source});
  if (!frames.empty()) frames.front() = {};
  return frames;
}

WalkMotion by_track_alone(const DisplacementTrack& track) {
  WalkMotion motion;
  motion.metric = track.scale == TrackScale::kMetric;
  for (const TrackedDisplacement& frame : track.frames) {
    motion.frames.push_back(
        frame.valid ? FrameDisplacement{frame.displacement, frame.sigma, DisplacementSource::kTrack}
                    : FrameDisplacement{});
  }
  return motion;
}

WalkMotion by_track_and_error(const Walk& walk, const VisualMotionOptions& options) {
  WalkMotion motion;
  motion.visual = visual_motion_if_any(walk, options);
  MotionEvidence evidence{.time_s = walk.time_s, .track = &*walk.track};
  if (motion.visual) {
    evidence.errors = &motion.visual->errors;
    evidence.errors_known = motion.visual->usable;
  }
  motion.frames = hybrid_as_published(evidence);
  return motion;
}

WalkMotion by_steps(const Walk& walk, const PedestrianMotionOptions& options) {
  WalkMotion motion;
  motion.pedestrian = pedestrian_motion(walk, options);
  motion.metric = true;
  motion.trajectory = motion.pedestrian->trajectory.at_frame;
  const bool steps = !motion.pedestrian->detection.steps.empty();
  motion.frames = from_one(motion.pedestrian->displacement_m,
                           steps ? DisplacementSource::kSteps : DisplacementSource::kNone, kUsualStepsError);
  return motion;
}

WalkMotion by_alignment_error(const Walk& walk, const VisualMotionOptions& options) {
  WalkMotion motion;
  motion.visual = visual_motion(walk, options);
  motion.frames =
      from_one(motion.visual->displacement, DisplacementSource::kAlignmentError, kUsualAlignmentError);
  return motion;
}

/// Frames whose steps could be seen or were filled in; nothing was in a jump of the clock.
std::vector<bool> steps_seen(const PedestrianMotion& motion, const Walk& walk) {
  std::vector<bool> seen = motion.signal.reliable;
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = seen[i] || motion.displacement_m[i] > 0;
  for (const ClockGap& gap : walk.gaps) seen[gap.frame] = false;
  return seen;
}

/// False where steps were found during less than half of the time that the camera is seen to move.
bool steps_throughout(const PedestrianMotion& motion, const Walk& walk, const std::vector<bool>& standing) {
  std::size_t moving = 0, stepping = 0;
  for (std::size_t i = 1; i < walk.frames(); ++i) {
    if (!walk.track || !walk.track->frames[i].valid || (!standing.empty() && standing[i])) continue;
    ++moving;
    stepping += motion.displacement_m[i] > 0 ? 1 : 0;
  }
  return !motion.detection.steps.empty() && 2 * stepping >= moving;
}

/// False if steps put the camera lower or higher than people carry one: the bounce and sway of a car may look
/// like steps.
bool carried(const PedestrianMotion& motion, const Walk& walk) {
  constexpr double kLowest_m = 0.5, kHighest_m = 3;  // from hip to above the head, and steps half as long
  if (!walk.track) return true;
  const std::optional<double> height_m = height_by_steps_m(*walk.track, motion.displacement_m);
  return !height_m || (*height_m >= kLowest_m && *height_m <= kHighest_m);
}

/// A camera that stays where it is.
WalkMotion standing_throughout(WalkMotion motion, const Walk& walk) {
  motion.frames = from_one(std::vector<double>(walk.frames(), 0), DisplacementSource::kAlignmentError, 0);
  if (motion.pedestrian) motion.trajectory = motion.pedestrian->trajectory.at_frame;
  return motion;
}

WalkMotion by_all(const Walk& walk, bool with_steps, const WalkMotionOptions& options) {
  WalkMotion motion;
  motion.visual = visual_motion_if_any(walk, options.visual);
  MotionEvidence evidence{.time_s = walk.time_s, .track = walk.track ? &*walk.track : nullptr};
  if (motion.visual) {
    evidence.errors = &motion.visual->errors;
    evidence.errors_known = motion.visual->usable;
    evidence.standing = motion.visual->standing;
  }
  if (with_steps) {
    motion.pedestrian = pedestrian_motion(walk, options.pedestrian);
    if (!carried(*motion.pedestrian, walk))
      motion.pedestrian = without_steps(std::move(*motion.pedestrian), options.pedestrian);
    if (steps_throughout(*motion.pedestrian, walk, evidence.standing)) {
      evidence.steps_m = motion.pedestrian->displacement_m;
      evidence.steps_known = steps_seen(*motion.pedestrian, walk);
    }
  }
  const bool file = walk.track && walk.track->scale != TrackScale::kPerSegment;
  if (!motion.visual && evidence.steps_m.empty() && !file)
    return standing_throughout(std::move(motion), walk);
  HybridMotion hybrid = hybrid_motion(evidence, options.hybrid);
  motion.frames = std::move(hybrid.frames);
  motion.metric = hybrid.metric;
  if (motion.pedestrian)
    motion.trajectory =
        dead_reckon(displacements(motion), motion.pedestrian->signal.heading_rad, walk.time_s);
  return motion;
}

/// The cadence of a walk whose clock is not the walker's.
std::optional<double> impossible_cadence_hz(const Walk& walk, const PedestrianMotionOptions& options) {
  const std::vector<double> clock_s = without_long_gaps(walk.time_s);
  if (walk.tracked.size() == walk.frames())
    return impossible_cadence_hz(walk.tracked, clock_s, options.signal, options.steps);
  // A clock that is not the walker's is so throughout: less than a minute shows it.
  constexpr double kLooked_s = 40;
  const double middle_s = (clock_s.front() + clock_s.back()) / 2;
  const auto begin = std::ranges::lower_bound(clock_s, middle_s - kLooked_s / 2);
  const auto end = std::ranges::upper_bound(clock_s, middle_s + kLooked_s / 2);
  std::vector<std::size_t> frames(static_cast<std::size_t>(end - begin));
  std::iota(frames.begin(), frames.end(), static_cast<std::size_t>(begin - clock_s.begin()));
  const cv::Size size(walk.frame_width_px, walk.frame_height_px);
  return impossible_cadence_hz(thumbnail_motion(select(walk.thumbnails, frames), size), {begin, end},
                               options.signal, options.steps);
}

WalkMotion motion_by(const Walk& walk, MotionSource source, const WalkMotionOptions& options) {
  const bool can_show_steps = walk.tracked.size() == walk.frames() &&
                              frame_rate_hz(walk.time_s) > 2 * options.pedestrian.signal.lowpass.cutoff_hz;
  switch (source) {
    case MotionSource::kSad:
      return by_alignment_error(walk, options.visual);
    case MotionSource::kSteps:
      return by_steps(walk, options.pedestrian);
    case MotionSource::kHybrid:
      return by_all(walk, can_show_steps, options);
    case MotionSource::kVisualOdometry:
    case MotionSource::kHybridAsPublished:
    case MotionSource::kFile:
      if (!walk.track) throw std::invalid_argument("walk_motion: a walk with a track expected");
      if (source == MotionSource::kFile) return by_all(walk, false, options);
      return source == MotionSource::kVisualOdometry ? by_track_alone(*walk.track)
                                                     : by_track_and_error(walk, options.visual);
    case MotionSource::kNone:
      break;
  }
  throw std::invalid_argument("walk_motion: a source expected");
}

}  // namespace

void keep_for(MotionSource source, WalkOptions& options) {
  options.track_features = source == MotionSource::kSteps || source == MotionSource::kHybrid;
  options.visual_odometry = source == MotionSource::kVisualOdometry || source == MotionSource::kHybrid ||
                            source == MotionSource::kHybridAsPublished;
}

WalkMotion walk_motion(const Walk& walk, MotionSource source, const WalkMotionOptions& options) {
  WalkMotion motion = motion_by(walk, source, options);
  motion.impossible_cadence_hz = impossible_cadence_hz(walk, options.pedestrian);
  if (motion.impossible_cadence_hz) {
    motion.warnings = {
        fmt::format("{}: {}", walk.source, impossible_cadence_text(*motion.impossible_cadence_hz))};
  }
  return motion;
}

WalkMotion motion_with_steps(const Walk& walk, MotionSource source, const WalkMotionOptions& options) {
  if (source != MotionSource::kHybrid && source != MotionSource::kSteps)
    throw std::invalid_argument("motion_with_steps: hybrid or steps expected");
  WalkMotion motion = walk_motion(walk, source, options);
  if (motion.pedestrian) return motion;
  return walk_motion(walk, MotionSource::kSteps, options);  // throws, and says why no steps can be seen
}

std::vector<double> displacements(const WalkMotion& motion) {
  std::vector<double> values;
  for (const FrameDisplacement& frame : motion.frames) values.push_back(frame.value);
  return values;
}

}  // namespace vo
