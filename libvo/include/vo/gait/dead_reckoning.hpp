#pragma once

#include "vo/base/trajectory.hpp"
#include "vo/gait/step_detection.hpp"

#include <span>
#include <vector>

namespace vo {

/// Settings of `dead_reckon` and `step_displacement_m`.
struct DeadReckoningOptions {
  /// A step goes in the direction of the heading at the frame it is found at [PVO 4.6]; left and right ones
  /// keep their own times.
  bool as_published = false;
  double pause_s = 1.5;  ///< longest step, seconds; before a later one the walker paused
};

/// A walk in the plane, metres from where it began.
struct DeadReckoning {
  std::vector<Pose2> at_step;  ///< after each step; heading that of the step
  Trajectory at_frame;         ///< at each frame; heading that of the frame
};

/// Metres walked from the frame before to each frame (the first: 0): each step's length, spread evenly over
/// the time since the step before it.
///
/// The extrema that mark steps come earlier on one side than on the other, as no trunk rolls evenly:
/// intervals that alternate between 0.36 s and 0.70 s are usual for steps of 0.53 s. So left and right steps
/// are each shifted in time by a constant, until both take equally long in the median, unless
/// `as_published`.
///
/// A step after a gap longer than `pause_s`, like the first, takes only its usual time: as long as the step
/// that follows, or the median of all, or half a second if there is no other. The walker is still before
/// that. The first step, and one more as long as the last, count by their `partial` shares. Apart from these,
/// the sum equals that of the lengths.
///
/// `lengths_m`: one per step; `time_s`: one per frame, increasing. Throws `std::invalid_argument` for another
/// number of lengths, shares outside 0 to 1, or step frames that decrease, are below 1, or are not frames of
/// the walk. Steps made in a gap of the clock all lie at the frame after it. O(n).
std::vector<double> step_displacement_m(std::span<const Step> steps, std::span<const double> lengths_m,
                                        std::span<const double> time_s, const PartialSteps& partial = {},
                                        const DeadReckoningOptions& options = {});

/// Joins steps and headings to a trajectory from (0, 0) (PVO 4.6):
/// x_i = x_(i-1) + length_i * sin(heading_i), y_i = y_(i-1) + length_i * cos(heading_i).
///
/// In PVO heading_i is the heading of the frame at which step i is found. There the trunk is turned furthest
/// to one side, and on a corner one step's frames look in many directions. So, unless `as_published`, a step
/// goes where the walker looks while taking it: length_i times the mean of (sin, cos) over its frames,
/// weighted by `step_displacement_m`; heading_i is the direction of that mean. Between steps, the pose moves
/// with that displacement; at a step's frame it is that step's pose.
///
/// `heading_rad`: one per frame, clockwise from +y; the rest as `step_displacement_m`. O(n).
DeadReckoning dead_reckon(std::span<const Step> steps, std::span<const double> lengths_m,
                          std::span<const double> heading_rad, std::span<const double> time_s,
                          const PartialSteps& partial = {}, const DeadReckoningOptions& options = {});

/// Joins displacements from any source and headings to the pose at each frame, from (0, 0):
/// x_i = x_(i-1) + displacement_i * sin(heading_i), y with cos. One of each per frame, `heading_rad`
/// clockwise from +y. Throws `std::invalid_argument` if the sizes disagree. O(n).
Trajectory dead_reckon(std::span<const double> displacement_m, std::span<const double> heading_rad,
                       std::span<const double> time_s);

}  // namespace vo
