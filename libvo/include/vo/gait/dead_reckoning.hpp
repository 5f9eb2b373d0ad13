#pragma once

#include "vo/base/trajectory.hpp"
#include "vo/gait/step_detection.hpp"

#include <span>
#include <vector>

namespace vo {

/// Settings of `dead_reckon` and `step_displacement_m`.
struct DeadReckoningOptions {
  /// At the frame that a step is found at, all of it is made, in the direction of the heading at that frame
  /// [PVO 4.6].
  bool as_published = false;
  double pause_s = 1.5;  ///< longest step, seconds; one that comes later was preceded by a stand
};

/// A walk in the plane, metres from where it began.
struct DeadReckoning {
  std::vector<Pose2> at_step;  ///< after each step; heading that of the step
  Trajectory at_frame;         ///< at each frame; heading that of the frame
};

/// Metres walked from the frame before to each frame (the first: 0): each step's length, spread evenly over
/// the time since the step before it.
///
/// The extrema that steps are found at come earlier on one side than on the other, as no trunk rolls evenly:
/// intervals of 0.36 s and 0.70 s by turns are usual for steps of 0.53 s. So the times of left and right
/// steps are moved, by a constant each, until both take equally long in the median; but not `as_published`.
///
/// A step after a gap longer than `pause_s`, like the first, takes only its usual time before it is done: as
/// long as the step that follows, or the median of all, or half a second if there is no other. The walker
/// stands still before that. Of the first step, and of one more of the length of the last, the `partial`
/// shares count. The sum is that of the lengths, but for these.
///
/// `lengths_m`: one per step; `time_s`: one per frame, increasing. Throws `std::invalid_argument` for another
/// number of lengths, shares outside 0 to 1, or steps whose frames decrease, are not from 1 on, or not among
/// the frames: steps made in a gap of the clock all lie at the frame after it. O(n).
std::vector<double> step_displacement_m(std::span<const Step> steps, std::span<const double> lengths_m,
                                        std::span<const double> time_s, const PartialSteps& partial = {},
                                        const DeadReckoningOptions& options = {});

/// Joins steps and headings to a trajectory from (0, 0) (PVO 4.6):
/// x_i = x_(i-1) + length_i * sin(heading_i), y_i = y_(i-1) + length_i * cos(heading_i).
///
/// In PVO heading_i is that of the frame at which step i is found. There the trunk is turned furthest to one
/// side; and on a corner one step's frames look in many directions. So, unless `as_published`, a step goes
/// where the walker looks while he takes it: length_i times the mean of (sin, cos) over its frames, weighted
/// by `step_displacement_m`, and heading_i is the direction of that. Between steps, the pose at a frame moves
/// with that displacement; at a step's frame it is that step's.
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
