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
  double min_step =
      0.75;  ///< least way, in steps, between one that is not sure, beside a stand, and the next
  StepWayOptions way;
  PeriodicityOptions periodicity;  ///< what is gait, in steps; a bounce is a step, not a stride
};

/// Finds steps in the bounce of the picture: it moves up fastest about when a foot lands, once a step, and
/// leaves off with the step that is not completed (not in PVO, whose orientation signal swings back as well
/// where the walker halts, and is weak where he starts).
///
/// A footfall is a valley of the bounce, in a stretch that is like gait, while the picture spreads as it does
/// when one walks forward; at most one in half a step. How many steps went into a longer gap, such as a
/// stand or a dark stretch, is told by how far the walker got in it: the spread summed over it, divided by
/// that of the steps around it, at least one. Likewise what was walked before the first footfall and after
/// the last: together with the steps between them, the walk has as many steps as were completed.
///
/// `bounce_px`: low-passed shift of the picture, without drift, down positive; `spread`: of the picture, low-
/// passed; both one per frame, unreliable frames bridged. `legs`: steps by the orientation, by which left is
/// told from right; without any, the first step is a left one. The rest as for `detect_steps`, in pixels for
/// degrees. No steps where nothing is like gait. O(n) and what `stride_periodicity` takes.
StepDetection detect_footfalls(std::span<const double> bounce_px, std::span<const double> spread,
                               std::span<const double> time_s, const std::vector<bool>& reliable,
                               std::span<const Step> legs, const FootfallOptions& options = {});

}  // namespace vo
