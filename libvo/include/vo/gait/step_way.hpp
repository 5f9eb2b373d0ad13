#pragma once

#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace vo {

/// Settings of `StepWay`.
struct StepWayOptions {
  double min_growth = 0.15;   ///< share of the usual growth from which one walks
  double min_way = 0.3;       ///< steps in the time of one, about a frame at which one walks
  double missed_ratio = 1.5;  ///< of a usual step: a longer gap may have lost steps, or be a stand
};

/// How far a walker got on between any two frames, in steps, as the growth of the picture tells it.
///
/// Things ahead grow in the picture at the rate of speed over distance. The distances differ from scene to
/// scene, so that the measure is the growth at the nearest steps that follow each other without a gap. Speed
/// is step length times cadence, and both grow alike with it (see `step_lengths_m`): cadence is the usual one
/// times the square root of the growth's share of the usual, at most 1. Below a least share one stands.
class StepWay {
 public:
  /// `growth`: share by which the picture grows, one per frame, low-passed, unreliable frames bridged;
  /// `time_s`: one per frame; `step_frames`: of sure steps, increasing. Keeps references to the first two.
  StepWay(std::span<const double> growth, std::span<const double> time_s,
          std::span<const std::size_t> step_frames, const StepWayOptions& options = {});

  /// False if no two steps followed each other: then there is no measure, and nothing below may be called.
  [[nodiscard]] bool known() const { return !steps_.empty(); }

  /// True if the picture grows at a frame as it does when one walks. O(log steps).
  [[nodiscard]] bool walking(std::size_t frame) const;

  /// True if two frames lie further apart than one step takes.
  [[nodiscard]] bool gap(std::size_t a, std::size_t b) const;

  /// Steps between two frames, by the measure at frame `measure`; as many as there was time for if the
  /// picture does not grow there, as in a turn before a wall. O(b - a).
  [[nodiscard]] double between(std::size_t a, std::size_t b, std::size_t measure) const;

  /// Seconds of a usual step about a frame. O(log steps).
  [[nodiscard]] double step_s(std::size_t frame) const { return usual(frame).seconds; }

 private:
  struct Interval {
    std::size_t end = 0;  ///< frame
    double seconds = 0;
    double growth = 0;  ///< mean of its frames
  };
  [[nodiscard]] Interval usual(std::size_t frame) const;  // medians of the nearest

  std::span<const double> growth_;
  std::span<const double> time_s_;
  StepWayOptions options_;
  std::vector<Interval> steps_;
};

/// The steps with those that the way says were lost, and without those twice seen.
///
/// In a gap, such as a stand, a dark stretch, or a weak step, there were as many steps as the way is long, to
/// the nearest whole number: the half step with which the feet come together at a halt makes one with that
/// of the next start. Where it is none, the step before the gap is the one after it, and the larger stays. A
/// walk begins and ends within a step: what was walked before the first and after the last, together, counts
/// in whole steps. Steps added are marked as bridged and alternate. O(frames + steps).
StepDetection complete_steps(StepDetection detection, const StepWay& way, std::span<const double> signal,
                             std::span<const double> time_s);

}  // namespace vo
