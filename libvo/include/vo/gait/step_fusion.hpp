#pragma once

#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// Settings of `fill_steps`.
struct StepFusionOptions {
  double few_matches = 0.25;  ///< share of the walk's median matches, below which a frame is poor
  double span_s = 1;          ///< seconds around a step in which most frames must be poor
  double apart_s = 0.3;       ///< least time between a filled-in step and any other: 1 / 0.3 s is a sprint
};

/// Fills in steps where few points were seen (PVO loses them there).
///
/// In the dark, noise hides the camera's roll in the median orientation long before it hides the swing from
/// side to side in the x shift, which has the same stride. So a step read from the shift is taken where most
/// frames around it are poor and no step read from the orientation is near. Its leg is opposite to that of
/// the step before it.
///
/// `orientation`, `shift`: steps of one walk from each signal; `matches`: for each frame; `time_s`: of each
/// frame. The result has the thresholds of `orientation`. Throws `std::invalid_argument` for another number
/// of matches than times. O(frames + steps * frames in a span).
StepDetection fill_steps(const StepDetection& orientation, const StepDetection& shift,
                         std::span<const std::size_t> matches, std::span<const double> time_s,
                         const StepFusionOptions& options = {});

}  // namespace vo
