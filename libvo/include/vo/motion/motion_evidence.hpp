#pragma once

#include "vo/motion/alignment_error.hpp"
#include "vo/motion/displacement_track.hpp"

#include <span>
#include <vector>

namespace vo {

/// What each source says about a walk's motion, one value per frame. All but the times may be missing (null,
/// empty).
struct MotionEvidence {
  std::vector<double> time_s;                ///< increasing
  const DisplacementTrack* track = nullptr;  ///< by visual odometry or from a file
  const AlignmentErrors* errors = nullptr;   ///< SSS 3.1
  std::vector<bool> errors_known;            ///< with `errors`: false where a frame's error shows nothing
  std::vector<bool> standing;                ///< true where the view has not changed for long
  std::vector<double> steps_m;               ///< displacement by steps, metres
  std::vector<bool> steps_known;             ///< with `steps_m`: false where steps could not be seen
};

/// Throws `std::invalid_argument` unless everything present has one value per frame.
void check(const MotionEvidence& evidence);

}  // namespace vo
