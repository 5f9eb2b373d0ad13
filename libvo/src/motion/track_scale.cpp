#include "vo/motion/track_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace vo {
namespace {

using Displacements = std::vector<std::optional<double>>;

/// Ranges of frames of one segment with a displacement. `over_losses`: a range continues, in its unit, after
/// lost frames; not after frames of the segment without a pose, where the camera was still or turned.
std::vector<FrameRange> runs_of(const DisplacementTrack& track, bool over_losses) {
  const auto posed = [&](std::size_t i) { return track.poses.size() != track.size() || track.poses[i]; };
  std::vector<FrameRange> runs;
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (!track.frames[i].valid) continue;
    const std::size_t end = runs.empty() ? 0 : runs.back().end;
    const bool goes_on = !runs.empty() && track.frames[end - 1].segment == track.frames[i].segment &&
                         (end == i || (over_losses && posed(end - 1) && posed(i)));
    if (!goes_on) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
  return runs;
}

double sum(const Displacements& values, FrameRange range, const std::vector<bool>& counted) {
  double total = 0;
  for (std::size_t i = range.begin; i < range.end; ++i)
    if (values[i] && counted[i]) total += *values[i];
  return total;
}

double sum(const std::vector<double>& values, FrameRange range, const std::vector<bool>& counted) {
  double total = 0;
  for (std::size_t i = range.begin; i < range.end; ++i) total += counted[i] ? values[i] : 0;
  return total;
}

FrameRange overlap(FrameRange a, FrameRange b) {
  return {std::max(a.begin, b.begin), std::max(std::max(a.begin, b.begin), std::min(a.end, b.end))};
}

/// All known heights above the ground in a range.
std::vector<double> heights_in(const DisplacementTrack& track, FrameRange range) {
  std::vector<double> all;
  for (std::size_t i = range.begin; i < range.end && !track.heights.empty(); ++i)
    all.insert(all.end(), track.heights[i].begin(), track.heights[i].end());
  return all;
}

/// Removes the drift of scale from a run: scales each frame by the camera's height in the whole run over that
/// in the seconds around it. Returns false, and does nothing, where too little ground is seen.
bool steady_by_ground(const MotionEvidence& evidence, const TrackScaleOptions& options, FrameRange run,
                      Displacements& moved) {
  constexpr double kDrift = 0.2;  // of the logarithm of scale within a run, standard deviation
  const std::optional<double> of_run = ground_height(heights_in(*evidence.track, run), {}, options.ground);
  if (!of_run) return false;
  double height = *of_run;
  for (std::size_t i = run.begin; i < run.end; ++i) {
    const FrameRange near = frames_around(evidence.time_s, {i, i + 1}, options.ground_window_s / 2);
    if (i == run.begin || !evidence.track->heights[i].empty()) {
      height = ground_height(heights_in(*evidence.track, overlap(near, run)), ExpectedHeight{*of_run, kDrift},
                             options.ground)
                   .value_or(*of_run);
    }
    if (moved[i]) *moved[i] *= *of_run / height;
  }
  return true;
}

/// Converts one range to metres, each frame by the steps within `window_s` around it; false if steps give no
/// scale or contradict it.
bool scale_by_steps(const MotionEvidence& evidence, const TrackScaleOptions& options, FrameRange run,
                    double window_s, const Displacements& track, Displacements& scaled) {
  constexpr double kLeast_m = 1;                 // of steps, to give a scale
  std::vector<bool> both(evidence.steps_known);  // say something
  for (std::size_t i = run.begin; i < run.end; ++i) both[i] = both[i] && track[i];
  // A step that was not found, like the first of a walk, has no length to compare.
  std::vector<bool> stepping(both);
  for (std::size_t i = run.begin; i < run.end; ++i) stepping[i] = stepping[i] && evidence.steps_m[i] > 0;
  const auto ratio = [&](FrameRange range) -> std::optional<double> {
    const double walked_m = sum(evidence.steps_m, range, stepping);
    const double passed = sum(track, range, stepping);
    if (walked_m < kLeast_m || !(passed > 0)) return std::nullopt;
    return walked_m / passed;
  };
  const std::optional<double> of_run = ratio(run);
  if (!of_run) return false;
  double difference_m = 0, walked_m = 0;
  for (std::size_t i = run.begin; i < run.end; ++i) {
    if (!track[i]) continue;
    const FrameRange near = frames_around(evidence.time_s, {i, i + 1}, window_s / 2);
    scaled[i] = *track[i] * ratio(overlap(near, run)).value_or(*of_run);
  }
  for (std::size_t i = run.begin; i < run.end;) {
    const FrameRange second{i, overlap(frames_around(evidence.time_s, {i, i + 1}, 1), run).end};
    const double by_steps_m = sum(evidence.steps_m, second, both);
    difference_m += std::abs(by_steps_m - sum(scaled, second, both));
    walked_m += by_steps_m;
    i = second.end;
  }
  if (difference_m <= options.max_disagreement * walked_m) return true;
  for (std::size_t i = run.begin; i < run.end; ++i) scaled[i].reset();
  return false;
}

/// Ties each run by the height of the camera, expected where speed and alignment error put it; by those alone
/// where too little ground is seen.
ScaledTrack tie_without_steps(const MotionEvidence& evidence, const TrackScaleOptions& options,
                              const std::vector<FrameRange>& runs, const Displacements& moved) {
  ScaledTrack tied{.displacement = Displacements(moved.size())};
  std::optional<double> camera_height;  // in the unit of the tied part
  for (const FrameRange& run : runs) {
    std::optional<SegmentTie> tie;
    if (&run == &runs.front()) {
      tie = SegmentTie{};
    } else {
      tie = combined(tie_by_speed(evidence.time_s, run, moved, tied.displacement, options.tie),
                     tie_by_relation(evidence, run, moved, tied.displacement, options.tie));
    }
    if (!tie) continue;
    std::optional<ExpectedHeight> expected;
    if (camera_height) expected = {*camera_height / tie->scale, tie->sigma};
    const std::optional<double> height =
        ground_height(heights_in(*evidence.track, run), expected, options.ground);
    if (height && !camera_height) camera_height = *height * tie->scale;
    const double scale = height ? *camera_height / *height : tie->scale;
    for (std::size_t i = run.begin; i < run.end; ++i)
      if (moved[i]) tied.displacement[i] = scale * *moved[i];
  }
  tied.by_ground = camera_height.has_value();
  if (!camera_height || !options.camera_height_m) return tied;
  for (std::optional<double>& displacement : tied.displacement)
    if (displacement) *displacement *= *options.camera_height_m / *camera_height;
  tied.metric = true;
  return tied;
}

}  // namespace

std::vector<std::optional<double>> smoothed_displacement(const DisplacementTrack& track,
                                                         std::span<const double> time_s, double smoothing_s) {
  if (time_s.size() != track.size())
    throw std::invalid_argument("smoothed_displacement: one time per frame expected");
  Displacements displacement(track.size());
  for (const FrameRange& run : runs_of(track, false)) {
    // The frame before the first has a pose too, unless the walk or the segment begins here.
    const bool posed_before = run.begin > 0 && track.poses.size() == track.size() &&
                              track.poses[run.begin - 1] &&
                              track.frames[run.begin - 1].segment == track.frames[run.begin].segment;
    const FrameRange posed{posed_before ? run.begin - 1 : run.begin, run.end};
    const bool has_poses = track.poses.size() == track.size() &&
                           std::all_of(track.poses.begin() + static_cast<std::ptrdiff_t>(posed.begin),
                                       track.poses.begin() + static_cast<std::ptrdiff_t>(posed.end),
                                       [](const auto& p) { return p.has_value(); });
    const auto smoothed = [&](std::size_t i) {
      const FrameRange near = overlap(frames_around(time_s, {i, i + 1}, smoothing_s / 2), posed);
      const std::size_t reach = std::min(i - near.begin, near.end - 1 - i);
      cv::Vec3d mean{0, 0, 0};
      for (std::size_t k = i - reach; k <= i + reach; ++k) mean += track.poses[k]->position;
      return mean / static_cast<double>(2 * reach + 1);
    };
    for (std::size_t i = run.begin; i < run.end; ++i) {
      displacement[i] = track.frames[i].displacement;
      if (has_poses && i > posed.begin) displacement[i] = cv::norm(smoothed(i) - smoothed(i - 1));
    }
  }
  return displacement;
}

ScaledTrack tie_track_scale(const MotionEvidence& evidence, const TrackScaleOptions& options) {
  check(evidence);
  if (evidence.track == nullptr) throw std::invalid_argument("tie_track_scale: a track expected");
  if (!(options.steps_window_s > 0 && options.ground_window_s > 0 && options.tie.relation_window_s > 0 &&
        options.max_disagreement > 0))
    throw std::invalid_argument("tie_track_scale: windows and disagreement above 0 expected");
  const DisplacementTrack& track = *evidence.track;
  Displacements moved = smoothed_displacement(track, evidence.time_s, options.smoothing_s);
  if (track.scale == TrackScale::kMetric) return {.displacement = moved, .metric = true};

  std::vector<FrameRange> runs;
  if (track.scale == TrackScale::kCommon) {
    runs = {{0, track.size()}};
  } else {
    for (const FrameRange& run : runs_of(track, true)) {
      if (evidence.time_s[run.end - 1] - evidence.time_s[run.begin] >= options.min_segment_s)
        runs.push_back(run);
    }
  }
  std::vector<bool> steady;
  for (const FrameRange& run : runs) steady.push_back(steady_by_ground(evidence, options, run, moved));
  if (evidence.steps_m.empty()) return tie_without_steps(evidence, options, runs, moved);

  ScaledTrack tied{.displacement = Displacements(track.size())};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double window_s = steady[i] ? options.steady_steps_window_s : options.steps_window_s;
    tied.metric |= scale_by_steps(evidence, options, runs[i], window_s, moved, tied.displacement);
  }
  return tied;
}

}  // namespace vo
