#pragma once

#include "vo/gait/periodicity.hpp"
#include "vo/gait/step_detection.hpp"
#include "vo/gait/step_way.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// Settings of `detect_footfalls`.
struct FootfallOptions {
  double min_depth = 0.2;   ///< least depth of a valley, of the bounce's amplitude around it
  double sure_depth = 0.5;  ///< depth from which a valley is a footfall even if nothing else moves
  double min_step = 0.75;   ///< steps of way from a footfall to one beside a stand that is not sure
  StepWayOptions way;
  PeriodicityOptions periodicity;  ///< what is gait, in steps; a bounce is a step, not a stride
};

/// What is like gait in the bounce, window by window: `step_s` is half of a bounce, that is of a step. O(n)
/// and what `stride_periodicity` takes.
std::vector<Periodicity> bounce_windows(std::span<const double> bounce_px, std::span<const double> time_s,
                                        const PeriodicityOptions& options = {});

/// Finds steps in the bounce of the picture, which moves up fastest about when a foot lands (not in PVO).
///
/// The roll that PVO reads is weak in the first step after a stand, and swings back where the walker halts
/// within a step; the bounce has one valley for each foot that lands, and none for a half step.
///
/// A footfall is a valley in a stretch that is like gait (`stride_periodicity`), at most one in half a step.
/// One that is not deep must have a walker who gets on about it, and not be the swing that follows a last
/// step. What was lost, seen twice, or not completed is told by the way (`complete_steps`).
///
/// `bounce_px`: shift of the picture, down positive, low-passed and without drift; `growth`: of the picture,
/// low-passed; one of each per frame, unreliable ones bridged. `legs`: steps by the orientation, by which
/// left is told from right; without any, the first step is a left one. `time_s`, `reliable` and the result as
/// of `detect_steps`, in pixels; no step is seen at an unreliable frame. No steps where nothing
/// is like gait. Throws `std::invalid_argument` for other sizes or depths out of range. O(n) and what
/// `stride_periodicity` takes.
StepDetection detect_footfalls(std::span<const double> bounce_px, std::span<const double> growth,
                               std::span<const double> time_s, const std::vector<bool>& reliable,
                               std::span<const Step> legs, const FootfallOptions& options = {});

}  // namespace vo
