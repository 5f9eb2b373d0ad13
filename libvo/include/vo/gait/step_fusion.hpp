#pragma once

#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// Settings of `fill_steps`.
struct StepFusionOptions {
  double few_matches = 0.25;  ///< share of the walk's median matches, below which a frame is poor
  double span_s = 1;          ///< seconds about a step of which most frames must be poor
  double apart_s = 0.3;       ///< least time between a step filled in and any other: 1 / 0.3 s is a sprint
};

/// Fills the steps in where few points were seen (not in PVO, which loses them there).
///
/// The noise of a median of orientations in the dark drowns the roll of the camera long before the noise of
/// the x shifts drowns its swing from side to side, which has the same stride. So a step read from the shift
/// is taken where most frames about it are poor and no step read from the orientation is near. Its leg is the
/// other one than the step before it.
///
/// `orientation`, `shift`: steps of one walk by either signal; `matches`: for each frame; `time_s`: of each
/// frame. The result has the thresholds of `orientation`. Throws `std::invalid_argument` for another number
/// of matches than times. O(frames + steps * frames in a span).
StepDetection fill_steps(const StepDetection& orientation, const StepDetection& shift,
                         std::span<const std::size_t> matches, std::span<const double> time_s,
                         const StepFusionOptions& options = {});

}  // namespace vo
