#pragma once

#include <string_view>

namespace vo {

/// Where the displacement of a walk's frames comes from.
enum class MotionSource {
  kNone,            ///< nowhere: every k-th frame (SSS's "vanilla")
  kSad,             ///< alignment error, through the learned motion model (SSS 3.2)
  kSteps,           ///< steps, in metres (PVO)
  kVisualOdometry,  ///< monocular visual odometry alone, as it is: nothing where it is lost, no common unit
  kHybridAsPublished,  ///< visual odometry, and alignment error where it is lost, no more (SSS 3.5)
  kHybrid,             ///< all of these, each where it is best
  kFile,               ///< a trajectory from a file, alignment error where it has gaps
};

/// "none", "sad", "steps", "vo", "vo-sad", "hybrid", "file".
std::string_view name_of(MotionSource source);

}  // namespace vo
