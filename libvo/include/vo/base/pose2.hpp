#pragma once

namespace vo {

/// A planar pose. x is metres east, y metres north; heading in radians clockwise from +y, so that the
/// direction of travel is (sin heading, cos heading), as in `truth.csv`.
struct Pose2 {
  double x_m = 0;
  double y_m = 0;
  double heading_rad = 0;
};

}  // namespace vo
