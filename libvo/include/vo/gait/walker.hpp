#pragma once

#include "vo/gait/gait_signal.hpp"
#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// Growth of the picture per second below which a camera is not taken to approach what it sees: that of a
/// walk at 1 m/s towards things 100 m away. Walks have 0.05 and more; a camera shaken on the spot, 0.001.
inline constexpr double kLeastGrowth_per_s = 0.01;

/// Angle by which the picture moves past in a second below which a camera is not taken to look out of a
/// window: a walk past a wall 25 m away. People who stand sway and look about, but not so far in 5 s.
inline constexpr double kLeastFlow_rad_s = 0.05;

/// The fewest and the most steps per second that people make: below is shuffling, above is sprinting.
inline constexpr double kSlowestSteps_hz = 1.2, kFastestSteps_hz = 3.5;

/// True at the frames around which the camera travels: the picture grows or shrinks by at least
/// `kLeastGrowth_per_s` in the mean over 5 s, in which sway and shaking cancel. O(n).
std::vector<bool> camera_travels(const GaitSignal& signal);

/// The picture's mean flow over the 5 s around each frame, as an angle in a second: of a camera that looks to
/// the side or down, whose picture flows past and does not grow. Empty if the signal has none. O(n).
std::vector<Flow> steady_flow(const GaitSignal& signal);

/// True at the frames of stretches in which the picture flows one way by a whole turn or more, faster than
/// `kLeastFlow_rad_s` (`steady_flow`): by less, somebody may turn around on the spot. O(n).
std::vector<bool> rides_past(const GaitSignal& signal, std::span<const Flow> steady);

/// True at the frames around which the bounce is a walker's and not a car's (not in PVO, where walkers wear
/// all cameras).
///
/// A body bounces evenly, step after step, and leans and sways with every other step; a car bounces with the
/// road. Two numbers from -1 to 1, medians over 20 s, measure this: how even the bounce is
/// (`stride_periodicity`), and how much the orientation, or else the x shift, swings at half its rate. A
/// bounce is a walker's if the first is at least 0.8 or their sum at least 1.2. Walks have 0.83 to 0.98 and
/// sums of 1.37 to 1.97; a car 0.65 and 0.91, with a mount that rattles at the rate of steps 0.71 and 0.89.
/// `bounce`: the windows of the bounce, in which `step_s` is half a step. O(windows * window).
std::vector<bool> bounces_like_walker(const GaitSignal& signal, std::span<const Periodicity> bounce);

/// Removes the steps at frames that are not `walked`, and stretches without a pause of `pause_s` in which the
/// cadence is lower or higher than people's. If the first or the last step is removed, the new one counts as
/// whole. Throws `std::invalid_argument` for another number of flags than the signal has frames. O(n).
StepDetection walkers_steps(StepDetection detection, const std::vector<bool>& walked, double pause_s = 1.5);

}  // namespace vo
