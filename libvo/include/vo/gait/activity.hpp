#pragma once

#include "vo/gait/periodicity.hpp"

#include <span>
#include <vector>

namespace vo {

enum class Activity {
  kStanding,
  kWalking,
  kRunning,
  kUnknown,  ///< too few matches to tell
};

/// Settings of `detect_activity`.
struct ActivityOptions {
  /// Steps per second from which one runs: 140 a minute, which tells running from walking in 91 % of bouts on
  /// a treadmill, where a speed of 2.1 m/s does in 55 % ("Cadence (steps/min) as an indicator of the
  /// walk-to-run transition", Human Movement Science 90, 2023).
  double run_step_hz = 140.0 / 60;
  double moving_ratio = 0.5;  ///< least amplitude of a second of gait, as a share of the gait's around it
  double min_reliable = 0.5;  ///< share of a second's frames with enough matches; below, nothing is known
  PeriodicityOptions periodicity;
};

/// What was done in one second.
struct ActivitySecond {
  double time_s = 0;  ///< its beginning
  Activity activity = Activity::kUnknown;
  double amplitude_deg = 0;  ///< of the orientation signal in it and a quarter second on either side
  double step_hz = 0;        ///< steps per second of the gait about it; 0 where there is none
};

/// Tells standing, walking and running by amplitude and frequency of the orientation signal, second by
/// second. PVO reports that it can be done (abstract), not how.
///
/// A second is of gait if most of its frames lie in windows of gait (`stride_periodicity`) and its own
/// amplitude is not far below theirs; else the walker stands. Gait is running from `run_step_hz` on;
/// amplitude says how vigorous a gait is, but differs more between persons and camera mounts than between
/// gaits.
///
/// The rest as for `detect_steps`: `signal_deg` low-passed, `time_s`, `reliable`, one per frame. Seconds
/// count from the first frame; the last may be shorter. Throws `std::invalid_argument` for other sizes or
/// options out of range. Empty for no frames; fewer than three are unknown. O(n) and what
/// `stride_periodicity` takes.
std::vector<ActivitySecond> detect_activity(std::span<const double> signal_deg,
                                            std::span<const double> time_s, const std::vector<bool>& reliable,
                                            const ActivityOptions& options = {});

}  // namespace vo
