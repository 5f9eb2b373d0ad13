#pragma once

#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace vo {

/// Settings of `StepWay`.
struct StepWayOptions {
  double min_growth = 0.2;   ///< share of the usual growth, over the time of a step, from which one walks
  double slow_growth = 0.5;  ///< share of the usual growth, over the time of a step, below which one may halt
  double min_stand = 2;      ///< steps: to stop and start again takes no less than their time
  double min_way = 0.3;      ///< steps in the time of one, about a frame at which one walks
  double missed_ratio = 1.5;  ///< of a usual step: a longer gap may have lost steps, or be a stand
};

/// How far a walker got on between any two frames, in steps, as the growth of the picture tells it.
///
/// Things ahead grow in the picture at the rate of speed over distance. The distances differ from scene to
/// scene, so that the measure is the growth at the nearest steps that follow each other without a gap. Speed
/// is step length times cadence, and both grow alike with it (see `step_lengths_m`): cadence is the usual one
/// times the square root of the growth's share of the usual, at most 1. One stands where the mean over the
/// time of a step is below a least share: over it, noise and sway make up for themselves. Where the picture
/// usually does not grow, as in a turn before a wall, the cadence is the usual one.
class StepWay {
 public:
  /// `growth`: share by which the picture grows, one per frame, low-passed, unreliable frames bridged;
  /// `time_s`: one per frame, referred to from then on; `step_frames`: of sure steps, increasing. O(frames *
  /// frames in a step).
  StepWay(std::span<const double> growth, std::span<const double> time_s,
          std::span<const std::size_t> step_frames, const StepWayOptions& options = {});

  /// False if no two steps followed each other: then there is no measure, and nothing below may be called.
  [[nodiscard]] bool known() const { return !way_.empty(); }

  /// True if the picture grows at a frame as it does when one walks. O(frames in a step).
  [[nodiscard]] bool walking(std::size_t frame) const;

  /// True if two frames lie further apart than one step takes.
  [[nodiscard]] bool gap(std::size_t a, std::size_t b) const;

  /// Steps from frame `a` to frame `b`.
  [[nodiscard]] double between(std::size_t a, std::size_t b) const { return way_[b] - way_[a]; }

  /// The frame at which so many steps after another are done; the last if they are not. O(log frames).
  [[nodiscard]] std::size_t after(std::size_t frame, double steps) const;

  /// Seconds of a usual step about a frame.
  [[nodiscard]] double step_s(std::size_t frame) const { return step_s_[frame]; }

 private:
  /// Frames within so many seconds of one: the first, and the one after the last.
  [[nodiscard]] std::pair<std::size_t, std::size_t> within(std::size_t frame, double seconds) const;

  /// Sets the usual speed where the growth is low for less time than a stand takes.
  void walk_on(std::span<const double> over_step, std::vector<double>& speed) const;

  std::span<const double> time_s_;
  StepWayOptions options_;
  std::vector<double> step_s_;  // usual, about each frame
  std::vector<double> way_;     // steps up to each frame
};

/// The steps with those that the way says were lost, and without those twice seen.
///
/// In a gap, such as a stand, a dark stretch, or a weak step, there were as many steps as the way is long, to
/// the nearest whole number: the half step with which the feet come together at a halt makes one with that
/// of the next start. Where it is none, the step before the gap is the one after it, and the larger stays. A
/// recording begins and ends within a step, or with the half step from or to a stand: before the first step
/// and after the last, some were lost if the way there is clearly longer than one. Steps added are marked as
/// bridged, stand where the way says, and alternate. What is left of the way at both ends is `partial`.
/// O(frames + steps * log frames).
StepDetection complete_steps(StepDetection detection, const StepWay& way, std::span<const double> signal,
                             std::span<const double> time_s);

}  // namespace vo
