#include "vo/motion/motion_source.hpp"

namespace vo {

std::string_view name_of(MotionSource source) {
  switch (source) {
    case MotionSource::kSad:
      return "sad";
    case MotionSource::kSteps:
      return "steps";
    case MotionSource::kVisualOdometry:
      return "vo";
    case MotionSource::kHybridAsPublished:
      return "vo-sad";
    case MotionSource::kHybrid:
      return "hybrid";
    case MotionSource::kFile:
      return "file";
    case MotionSource::kNone:
      break;
  }
  return "none";
}

}  // namespace vo
