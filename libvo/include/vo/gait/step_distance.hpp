#pragma once

#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace vo {

/// Settings of `StepDistance`.
struct StepDistanceOptions {
  double min_growth = 0.2;    ///< share of the usual growth, over a step's time, from which the walker moves
  double slow_growth = 0.5;   ///< share of the usual growth, over a step's time, below which it may be a halt
  double min_stand = 2;       ///< shortest pause, in steps' time: to stop and start again takes that long
  double min_distance = 0.3;  ///< steps made in the time of one, around a frame at which the walker moves
  double missed_ratio = 1.5;  ///< times a usual step: a longer gap may hide lost steps or be a pause
};

/// How far a walker moved between any two frames, in steps, measured by the growth of the picture.
///
/// Things ahead grow in the picture at the rate of speed over their distance. Distances differ from scene to
/// scene, so growth is compared with the usual growth: that at the nearest steps without a gap between them.
/// Speed is step length times cadence, which grow alike with it (see `step_lengths_m`): cadence is the usual
/// one times the square root of growth over usual growth, at most 1. The walker is still where mean growth
/// over the time of a step, in which noise and sway cancel, is below a least share. Where the picture usually
/// does not grow, as in a turn before a wall, the cadence is the usual one.
class StepDistance {
 public:
  /// `growth`: share by which the picture grows, one per frame, low-passed, unreliable frames bridged;
  /// `time_s`: one per frame, must outlive the object; `step_frames`: of sure steps, increasing. O(frames *
  /// frames in a step).
  StepDistance(std::span<const double> growth, std::span<const double> time_s,
               std::span<const std::size_t> step_frames, const StepDistanceOptions& options = {});

  /// False if no two steps followed each other: then growth has no scale, and nothing below may be called.
  [[nodiscard]] bool known() const { return !steps_.empty(); }

  /// True if the picture grows at a frame as it does in walking. O(frames in a step).
  [[nodiscard]] bool walking(std::size_t frame) const;

  /// True if two frames lie further apart than one step takes.
  [[nodiscard]] bool gap(std::size_t a, std::size_t b) const;

  /// Steps from frame `a` to frame `b`.
  [[nodiscard]] double between(std::size_t a, std::size_t b) const { return steps_[b] - steps_[a]; }

  /// The first frame at which `steps` more have been made since `frame`; the last frame if there is none.
  /// O(log frames).
  [[nodiscard]] std::size_t after(std::size_t frame, double steps) const;

  /// Duration of a usual step near a frame, seconds.
  [[nodiscard]] double step_s(std::size_t frame) const { return step_s_[frame]; }

 private:
  /// Frames within `seconds` of a frame: the first, and the one after the last.
  [[nodiscard]] std::pair<std::size_t, std::size_t> within(std::size_t frame, double seconds) const;

  /// Sets the usual speed where growth is low for less time than a pause takes.
  void walk_on(std::span<const double> over_step, std::vector<double>& speed) const;

  std::span<const double> time_s_;
  StepDistanceOptions options_;
  std::vector<double> step_s_;  // usual, near each frame
  std::vector<double> steps_;   // steps up to each frame
};

/// Adds the steps that the distance walked shows were lost, and removes those seen twice.
///
/// A gap, such as a pause, a dark stretch or a weak step, has as many steps as its distance, rounded: the
/// half step that brings the feet together at a halt and the half step of the next start make one. If that is
/// zero, the steps before and after the gap are the same step, and the larger stays. A recording begins and
/// ends within a step, or with the half step out of or into a pause: before the first step and after the
/// last, steps were lost if the distance there is clearly longer than one. Added steps are marked as bridged,
/// placed by distance, and alternate. The distance left over at both ends is `partial`. O(frames + steps *
/// log frames).
StepDetection complete_steps(StepDetection detection, const StepDistance& walked,
                             std::span<const double> signal, std::span<const double> time_s);

}  // namespace vo
