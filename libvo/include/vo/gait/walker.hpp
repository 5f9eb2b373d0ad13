#pragma once

#include "vo/gait/gait_signal.hpp"
#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// Growth of the picture, a second, below which a camera is not taken to get nearer to what it sees: a walker
/// of 1 m/s in front of things 100 m off has it. Walks have 0.05 and more; a camera that is shaken on the
/// spot, 0.001.
inline constexpr double kLeastGrowth_per_s = 0.01;

/// The fewest and the most steps a second that people make: below it one shuffles, above one sprints.
inline constexpr double kSlowestSteps_hz = 1.2, kFastestSteps_hz = 3.5;

/// True at the frames about which the camera gets nearer to what it sees: the picture grows by
/// `kLeastGrowth_per_s`, or shrinks, in the mean over 5 s. Sway and shaking come back to where they were.
/// O(n).
std::vector<bool> gets_on(const GaitSignal& signal);

/// True at the frames about which a bounce is that of a walker, not of a car (not in PVO, whose cameras are
/// all worn by walkers).
///
/// A body bounces evenly, step after step, and leans and sways with every other one; a car bounces as the
/// road has it. Both are measured from -1 to 1, in the median over 20 s: how even the bounce is
/// (`stride_periodicity`), and how much the orientation, or else the x shift, swings at half its rate. A
/// bounce is a walker's if it is even to 0.8, or both together come to 1.2. Walks have 0.83 to 0.98 and 1.37
/// to 1.97; a car 0.65 and 0.91, with a mount that rattles at the rate of steps 0.71 and 0.89. `bounce`: the
/// windows of the bounce, in which `step_s` is half a step. O(windows * window).
std::vector<bool> bounces_as_walker(const GaitSignal& signal, std::span<const Periodicity> bounce);

/// Leaves out the steps at frames that are not `walked`, and the stretches without a pause of `pause_s` in
/// which steps are fewer or more than people make. What is left of the first and the last step is whole where
/// they were left out. Throws `std::invalid_argument` for another number of flags than the signal has frames.
/// O(n).
StepDetection walkers_steps(StepDetection detection, const std::vector<bool>& walked, double pause_s = 1.5);

}  // namespace vo
