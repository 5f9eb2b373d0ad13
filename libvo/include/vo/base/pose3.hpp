#pragma once

#include <opencv2/core/matx.hpp>

namespace vo {

/// A pose in space: a point of the body is at `rotation * point + position` in the world (world_from_body).
/// Camera axes are x right, y down, z forward.
struct Pose3 {
  cv::Matx33d rotation = cv::Matx33d::eye();
  cv::Vec3d position{0, 0, 0};
};

}  // namespace vo
