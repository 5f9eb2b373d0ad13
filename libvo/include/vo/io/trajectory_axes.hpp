#pragma once

#include "vo/io/pose_series_io.hpp"

#include <span>

namespace vo {

/// What a trajectory's axes were found to be.
struct FoundAxes {
  BodyAxes body = BodyAxes::kNone;
  GroundPlane ground = GroundPlane::kUnknown;
};

/// Finds out how the axes of a trajectory lie. People, cars and robots move forward, so the body's axis that
/// points along the path is its forward one: z of a camera, x of a vehicle. That gives the body's up (-y or
/// z), and its mean over the walk shows which of the world's axes is up. Where the orientations do not follow
/// the path (all equal, or a camera that looks aside), the ground plane is the one in which the path is flat:
/// y or z has less than a tenth of the other's extent. A body that does not move is taken to have retrace's
/// own axes. O(poses).
FoundAxes find_axes(std::span<const Pose3> poses);

}  // namespace vo
