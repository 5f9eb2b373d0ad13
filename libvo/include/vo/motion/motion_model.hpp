#pragma once

#include "vo/motion/alignment_error.hpp"

#include <span>
#include <vector>

namespace vo {

/// The learned relation of alignment error and frame separation (SSS 3.2, Fig. 3): knots strictly increasing
/// in both, joined by a second-order spline. Fewer than two knots: nothing was learned, and every motion is
/// 0.
struct MotionModel {
  std::vector<double> error;       ///< standard deviations of a patch
  std::vector<double> separation;  ///< frames at the mean speed of the walk it was learned on
};

}  // namespace vo
