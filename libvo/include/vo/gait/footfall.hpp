#pragma once

#include "vo/gait/periodicity.hpp"
#include "vo/gait/step_detection.hpp"
#include "vo/gait/step_distance.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// Settings of `detect_footfalls`.
struct FootfallOptions {
  double min_depth = 0.2;   ///< least depth of a valley, of the bounce's amplitude around it
  double sure_depth = 0.5;  ///< depth from which a valley is a footfall even if nothing else moves
  double min_step = 0.75;   ///< steps of distance from a footfall to an unsure one beside a pause
  StepDistanceOptions distance;
  PeriodicityOptions periodicity;  ///< what counts as gait; rates are of bounces, one a step
};

/// How much the bounce resembles gait, window by window. `step_s` is half a bounce, i.e. half a step. O(n)
/// plus the cost of `stride_periodicity`.
std::vector<Periodicity> bounce_windows(std::span<const double> bounce_px, std::span<const double> time_s,
                                        const PeriodicityOptions& options = {});

/// Finds steps in the bounce of the picture, which moves up fastest about when a foot lands (not in PVO).
///
/// The roll that PVO reads is weak in the first step after a pause, and swings back where the walker halts
/// within a step. The bounce has one valley for each foot that lands, and none for a half step.
///
/// A footfall is a valley in a stretch that resembles gait (`stride_periodicity`), at most one in half a
/// step. A shallow valley counts only where the walker moves forward, and not if it is the swing after a last
/// step. The distance walked shows which steps were lost, seen twice, or not completed (`complete_steps`).
///
/// `bounce_px`: shift of the picture, down positive, low-passed and without drift; `growth`: of the picture,
/// low-passed; one of each per frame, unreliable frames bridged. `legs`: steps from the orientation, which
/// show left from right; without any, the first step is a left one. `time_s`, `reliable` and the result are
/// as in `detect_steps`, in pixels. No step is seen at an unreliable frame, nor where nothing resembles
/// gait. Throws `std::invalid_argument` for other sizes or depths out of range. O(n) plus the cost of
/// `stride_periodicity`.
StepDetection detect_footfalls(std::span<const double> bounce_px, std::span<const double> growth,
                               std::span<const double> time_s, const std::vector<bool>& reliable,
                               std::span<const Step> legs, const FootfallOptions& options = {});

}  // namespace vo
