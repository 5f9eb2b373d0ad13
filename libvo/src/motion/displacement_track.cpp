#include "vo/motion/displacement_track.hpp"

namespace vo {

std::string_view name_of(TrackLoss loss) {
  switch (loss) {
    case TrackLoss::kNone:
      return "none";
    case TrackLoss::kTooFewCorners:
      return "too_few_corners";
    case TrackLoss::kTooFewInliers:
      return "too_few_inliers";
    case TrackLoss::kLowParallax:
      return "low_parallax";
    case TrackLoss::kPoorSpread:
      return "poor_spread";
    case TrackLoss::kJump:
      return "jump";
    case TrackLoss::kGap:
      return "gap";
  }
  return "unknown";
}

}  // namespace vo
