#include "vo/motion/track_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace vo {
namespace {

using Displacements = std::vector<std::optional<double>>;

/// Ranges of frames with a displacement, of one segment each.
std::vector<FrameRange> runs_of(const DisplacementTrack& track) {
  std::vector<FrameRange> runs;
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (!track.frames[i].valid) continue;
    const bool goes_on = !runs.empty() && runs.back().end == i && i > 0 &&
                         track.frames[i - 1].segment == track.frames[i].segment;
    if (!goes_on) runs.push_back({i, i});
    ++runs.back().end;
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

/// One range in metres, each frame by the seconds around it; false if steps tell no scale or contradict it.
bool scale_by_steps(const MotionEvidence& evidence, const TrackScaleOptions& options, FrameRange run,
                    const Displacements& track, Displacements& scaled) {
  constexpr double kLeast_m = 1;  // of steps, to tell a scale by
  // A step that was not found, like the first of a walk, has no length to compare.
  std::vector<bool> stepping(evidence.steps_known);
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
    const FrameRange near = frames_around(evidence.time_s, {i, i + 1}, options.steps_window_s / 2);
    scaled[i] = *track[i] * ratio(overlap(near, run)).value_or(*of_run);
  }
  for (std::size_t i = run.begin; i < run.end;) {
    const FrameRange second{i, overlap(frames_around(evidence.time_s, {i, i + 1}, 1), run).end};
    const double by_steps_m = sum(evidence.steps_m, second, evidence.steps_known);
    difference_m += std::abs(by_steps_m - sum(scaled, second, evidence.steps_known));
    walked_m += by_steps_m;
    i = second.end;
  }
  if (difference_m <= options.max_disagreement * walked_m) return true;
  for (std::size_t i = run.begin; i < run.end; ++i) scaled[i].reset();
  return false;
}

/// The factor that brings a run to the unit of what is tied before it.
std::optional<double> scale_by_relation(const MotionEvidence& evidence, const TrackScaleOptions& options,
                                        FrameRange run, const Displacements& track,
                                        const Displacements& tied) {
  if (evidence.errors == nullptr) return std::nullopt;
  const FrameRange first{run.begin, run.begin + 1};
  const FrameRange near = frames_around(evidence.time_s, first, options.relation_window_s);
  const FrameRange after{run.begin, std::min(run.end, near.end)};
  // As many tied frames as the window has, from further back if the loss was long.
  const std::size_t wanted = near.end - run.begin;
  FrameRange before{run.begin, run.begin};
  for (std::size_t found = 0; before.begin > 0 && found < wanted; --before.begin)
    found += tied[before.begin - 1] ? 1 : 0;
  const std::vector<double> predicted =
      predict_displacement(*evidence.errors, evidence.errors_known, tied, before, after, options.relation);
  double by_relation = 0;
  for (std::size_t i = 0; i < predicted.size(); ++i)
    by_relation += evidence.errors_known[after.begin + i] ? predicted[i] : 0;
  const double by_track = sum(track, after, evidence.errors_known);
  if (!(by_relation > 0 && by_track > 0)) return std::nullopt;
  return by_relation / by_track;
}

}  // namespace

std::vector<std::optional<double>> smoothed_displacement(const DisplacementTrack& track,
                                                         std::span<const double> time_s, double smoothing_s) {
  if (time_s.size() != track.size())
    throw std::invalid_argument("smoothed_displacement: one time per frame expected");
  Displacements displacement(track.size());
  for (const FrameRange& run : runs_of(track)) {
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
  if (!(options.steps_window_s > 0 && options.relation_window_s > 0 && options.max_disagreement > 0))
    throw std::invalid_argument("tie_track_scale: windows and disagreement above 0 expected");
  const DisplacementTrack& track = *evidence.track;
  const Displacements displacement = smoothed_displacement(track, evidence.time_s, options.smoothing_s);
  if (track.scale == TrackScale::kMetric) return {displacement, true};

  std::vector<FrameRange> runs;
  if (track.scale == TrackScale::kCommon) {
    runs = {{0, track.size()}};
  } else {
    for (const FrameRange& run : runs_of(track)) {
      if (evidence.time_s[run.end - 1] - evidence.time_s[run.begin] >= options.min_segment_s)
        runs.push_back(run);
    }
  }
  ScaledTrack tied{Displacements(track.size()), false};
  for (const FrameRange& run : runs) {
    if (!evidence.steps_m.empty() && scale_by_steps(evidence, options, run, displacement, tied.displacement))
      tied.metric = true;
  }
  if (tied.metric || !evidence.steps_m.empty()) return tied;
  bool first = true;
  for (const FrameRange& run : runs) {
    const std::optional<double> scale =
        first ? 1.0 : scale_by_relation(evidence, options, run, displacement, tied.displacement);
    if (!scale) continue;
    first = false;
    for (std::size_t i = run.begin; i < run.end; ++i)
      if (displacement[i]) tied.displacement[i] = *scale * *displacement[i];
  }
  return tied;
}

}  // namespace vo
