#pragma once

#include "vo/gait/gait_signal.hpp"
#include "vo/gait/step_detection.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace vo {

enum class Activity {
  kStanding,
  kWalking,
  kRunning,
  kRiding,   ///< the camera gets on without steps: in a car, on wheels, or steadied until none shows
  kUnknown,  ///< too few points to tell, or between the two
};

/// "standing", "walking", "running", "riding", "unknown".
std::string_view name_of(Activity activity);

/// Settings of `detect_activity`.
struct ActivityOptions {
  /// Steps per second from which one runs: 140 a minute, which tells running from walking in 91 % of bouts on
  /// a treadmill, where a speed of 2.1 m/s does in 55 % ("Cadence (steps/min) as an indicator of the
  /// walk-to-run transition", Human Movement Science 90, 2023).
  double run_step_hz = 140.0 / 60;
  double min_reliable = 0.5;  ///< share of a second's frames with enough points; below, nothing is known
  double pause_s = 1.5;       ///< longest step
};

/// What was done in one second.
struct ActivitySecond {
  double time_s = 0;  ///< its beginning
  Activity activity = Activity::kUnknown;
  double amplitude_deg = 0;  ///< of the orientation signal in it and a quarter second on either side
  double step_hz = 0;        ///< steps per second in it; 0 where none were made
};

/// Tells standing, walking, running and riding, second by second, by the steps that were found. PVO reports
/// that it can be done (abstract), not how; by the signal itself, as amplitude and frequency, the same second
/// would be told otherwise than by its steps.
///
/// A second is of gait if steps take up half of it or more: each the time since the one before, the first
/// after a pause as long as the next, one begun after the last its share. From `run_step_hz` on it is
/// running. Of the others, one stands in those in which the picture does not grow (`kLeastGrowth_per_s`); in
/// those in which it does, one rides if there is no step within 5 s, and else nobody knows.
///
/// `signal`: at the frames of the walk; `steps`, `partial`: as found. Seconds count from the first frame; the
/// last may be shorter. Throws `std::invalid_argument` for options out of range. Empty for no frames; fewer
/// than three are unknown. O(frames + steps).
std::vector<ActivitySecond> detect_activity(const GaitSignal& signal, std::span<const Step> steps,
                                            const PartialSteps& partial = {},
                                            const ActivityOptions& options = {});

}  // namespace vo
