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
  kRiding,   ///< the camera travels without steps: in a car, on wheels, or so steady that none shows
  kUnknown,  ///< too few points to say, or between two activities
};

/// "standing", "walking", "running", "riding", "unknown".
std::string_view name_of(Activity activity);

/// Settings of `detect_activity`.
struct ActivityOptions {
  /// Steps per second from which a second counts as running: 140 a minute, which separates running from
  /// walking in 91 % of bouts on a treadmill; a speed of 2.1 m/s does so in 55 % ("Cadence (steps/min) as an
  /// indicator of the walk-to-run transition", Human Movement Science 90, 2023).
  double run_step_hz = 140.0 / 60;
  double shortest_run_s = 3;  ///< in a walk: five steps and more, of which some are read early or late
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

/// Classifies each second as standing, walking, running or riding by the steps found in it. PVO reports that
/// this can be done (abstract), not how. The signal's own amplitude and frequency could contradict the steps,
/// so they are not used.
///
/// A second is gait if steps take up half of it or more. A step takes the time since the one before; the
/// first after a pause takes as long as the next; one begun after the last takes its share. From
/// `run_step_hz` on, gait is running, unless it is so for less than `shortest_run_s` next to walking. Any
/// other second is standing if the picture neither grows (`kLeastGrowth_per_s`) nor flows past
/// (`kLeastFlow_rad_s`, in it and in the 5 s around it), as it does for a camera that looks out of a window
/// to the side. If it grows, or flows past by more than a whole turn (`rides_past`), the second is riding
/// where no step is within 5 s, in a walk that is longer than that. It is unknown otherwise.
///
/// `signal`: at the frames of the walk; `steps`, `partial`: as detected. Seconds count from the first frame;
/// the last may be shorter. Throws `std::invalid_argument` for options out of range. Empty for no frames;
/// unknown for fewer than three. O(frames + steps).
std::vector<ActivitySecond> detect_activity(const GaitSignal& signal, std::span<const Step> steps,
                                            const PartialSteps& partial = {},
                                            const ActivityOptions& options = {});

}  // namespace vo
