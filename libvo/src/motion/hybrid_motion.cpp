#include "vo/motion/hybrid_motion.hpp"

#include "vo/base/clock.hpp"
#include "vo/motion/motion_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>

namespace vo {
namespace {

using Displacements = std::vector<std::optional<double>>;

/// Root mean square difference over seconds, as a share of the mean of `truth`; none if there is too little
/// of it.
std::optional<double> relative_error(std::span<const double> time_s, const Displacements& truth,
                                     const Displacements& other) {
  constexpr std::size_t kFewSeconds = 5;
  double square = 0, total = 0, truth_sum = 0, other_sum = 0, length_s = 0;
  std::size_t seconds = 0;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (!truth[i] || !other[i]) continue;
    truth_sum += *truth[i];
    other_sum += *other[i];
    length_s += time_s[i] - time_s[i - 1];
    if (length_s < 1) continue;
    square += (other_sum - truth_sum) * (other_sum - truth_sum);
    total += truth_sum;
    ++seconds;
    truth_sum = other_sum = length_s = 0;
  }
  if (seconds < kFewSeconds || !(total > 0)) return std::nullopt;
  const auto count = static_cast<double>(seconds);
  return std::sqrt(square / count) / (total / count);
}

/// Variation of speed, as a share of its mean.
double speed_variation(const std::vector<FrameDisplacement>& frames, std::span<const double> time_s) {
  double sum = 0, square = 0, count = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (frames[i].source == DisplacementSource::kHeld) continue;
    const double speed = frames[i].value / (time_s[i] - time_s[i - 1]);
    sum += speed;
    square += speed * speed;
    ++count;
  }
  if (!(sum > 0)) return 0;
  return std::sqrt(std::max(0.0, square * count / (sum * sum) - 1));
}

Displacements steps_of(const MotionEvidence& evidence) {
  Displacements steps(evidence.time_s.size());
  for (std::size_t i = 1; i < evidence.steps_m.size(); ++i)
    if (evidence.steps_known[i]) steps[i] = evidence.steps_m[i];
  return steps;
}

/// Alignment error as displacement, in the unit of `known` if anything is known; otherwise over frame
/// separation.
Displacements errors_as_displacement(const MotionEvidence& evidence, const Displacements& known,
                                     const std::vector<FrameRange>& targets,
                                     const HybridMotionOptions& options) {
  Displacements displacement(evidence.time_s.size());
  if (evidence.errors == nullptr) return displacement;
  const AlignmentErrors& errors = *evidence.errors;
  const auto put = [&](FrameRange target, const Displacements& values) {
    for (std::size_t i = target.begin; i < target.end && !values.empty(); ++i)
      if (evidence.errors_known[i]) displacement[i] = values[i - target.begin];
  };
  if (std::ranges::none_of(known, [](const auto& d) { return d && *d > 0; })) {
    std::vector<bool> excluded = evidence.errors_known;
    excluded.flip();
    for (std::size_t i = 0; i < evidence.standing.size(); ++i)
      excluded[i] = excluded[i] || evidence.standing[i];
    const MotionModel model = learn_motion_model(mean_errors(errors, excluded));
    put({0, displacement.size()},
        apply_motion_model(errors, model, evidence.time_s, options.relation.separations,
                           options.relation.max_speed));
    return displacement;
  }
  for (const FrameRange& target : targets) {
    Displacements values = predict_displacement(errors, evidence.time_s, evidence.errors_known, known,
                                                frames_around(evidence.time_s, target, options.window_s),
                                                target, options.relation);
    if (values.empty())
      values = predict_displacement(errors, evidence.time_s, evidence.errors_known, known,
                                    {0, displacement.size()}, target, options.relation);
    put(target, values);
  }
  return displacement;
}

/// Mean speed over the second before or after a range, over frames that were not held; none if there are
/// none.
std::optional<double> speed_beside(const std::vector<FrameDisplacement>& frames,
                                   std::span<const double> time_s, FrameRange range, bool after) {
  double moved = 0, length_s = 0;
  const auto take = [&](std::size_t i) {
    if (frames[i].source == DisplacementSource::kHeld) return false;
    moved += frames[i].value;
    length_s += time_s[i] - time_s[i - 1];
    return length_s < 1;
  };
  if (after) {
    for (std::size_t i = range.end; i < frames.size() && take(i);) ++i;
  } else {
    for (std::size_t i = range.begin; i > 1 && take(i - 1);) --i;
  }
  if (!(length_s > 0)) return std::nullopt;
  return moved / length_s;
}

/// Fills the frames marked `kHeld`.
void hold_speed(std::vector<FrameDisplacement>& frames, std::span<const double> time_s) {
  std::vector<bool> held(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) held[i] = frames[i].source == DisplacementSource::kHeld;
  const double variation = speed_variation(frames, time_s);
  for (const FrameRange& range : marked_ranges(held)) {
    const auto before = speed_beside(frames, time_s, range, false);
    const auto after = speed_beside(frames, time_s, range, true);
    const double from = before.value_or(after.value_or(0)), to = after.value_or(from);
    const double begin_s = time_s[range.begin - 1], length_s = time_s[range.end - 1] - begin_s;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const double frame_s = time_s[i] - time_s[i - 1];
      if (frame_s > kLongestFilledGap_s) continue;  // what happened in it is not known
      const double share = (time_s[i] - frame_s / 2 - begin_s) / length_s;
      frames[i].value = std::lerp(from, to, share) * frame_s;
      frames[i].sigma = variation * frames[i].value;
    }
  }
}

}  // namespace

std::string_view name_of(DisplacementSource source) {
  switch (source) {
    case DisplacementSource::kTrack:
      return "vo";
    case DisplacementSource::kSteps:
      return "steps";
    case DisplacementSource::kAlignmentError:
      return "sad";
    case DisplacementSource::kHeld:
      return "held";
    case DisplacementSource::kNone:
      break;
  }
  return "none";
}

HybridMotion hybrid_motion(const MotionEvidence& evidence, const HybridMotionOptions& options) {
  check(evidence);
  const std::size_t count = evidence.time_s.size();
  if (count < 2) throw std::invalid_argument("hybrid_motion: at least two frames expected");
  HybridMotion motion;
  motion.frames.resize(count);

  ScaledTrack track{.displacement = Displacements(count)};
  if (evidence.track != nullptr) track = tie_track_scale(evidence, options.scale);
  const Displacements steps = steps_of(evidence);
  const bool has_steps = !evidence.steps_m.empty();
  motion.metric = track.metric || has_steps;

  // What alignment error is learned from: the track, or without one the steps.
  Displacements known = track.displacement;
  if (std::ranges::none_of(known, [](const auto& d) { return d && *d > 0; })) known = steps;
  std::vector<bool> lost(count);
  for (std::size_t i = 1; i < count; ++i) lost[i] = !track.displacement[i];
  const Displacements errors = errors_as_displacement(evidence, known, marked_ranges(lost), options);
  const Displacements errors_everywhere = errors_as_displacement(evidence, known, {{0, count}}, options);

  const double steps_error =
      relative_error(evidence.time_s, track.displacement, steps).value_or(kUsualStepsError);
  const double errors_error =
      relative_error(evidence.time_s, known, errors_everywhere).value_or(kUsualAlignmentError);
  double scale_error = errors_error / std::sqrt(options.scale.tie.relation_window_s);
  if (track.by_ground) scale_error = kUsualGroundError;
  if (track.metric && has_steps) scale_error = steps_error / std::sqrt(options.scale.steps_window_s);

  for (std::size_t i = 1; i < count; ++i) {
    FrameDisplacement& frame = motion.frames[i];
    // A black picture does not change either, and a blurred one not much; nobody steps while standing.
    const bool seen = evidence.errors == nullptr || evidence.errors_known[i];
    const bool stepping = steps[i] && *steps[i] > 0;
    const bool still = seen && !stepping && !evidence.standing.empty() && evidence.standing[i];
    if (track.displacement[i]) {
      frame = {*track.displacement[i], scale_error * *track.displacement[i], DisplacementSource::kTrack};
    } else if (still) {
      frame = {0, 0, DisplacementSource::kAlignmentError};
    } else if (steps[i] && (!errors[i] || steps_error <= errors_error)) {
      frame = {*steps[i], steps_error * *steps[i], DisplacementSource::kSteps};
    } else if (errors[i]) {
      frame = {*errors[i], errors_error * *errors[i], DisplacementSource::kAlignmentError};
    } else {
      frame.source = DisplacementSource::kHeld;
    }
  }
  hold_speed(motion.frames, evidence.time_s);
  return motion;
}

}  // namespace vo
