#pragma once

#include "vo/io/pose_series_io.hpp"

#include <span>

namespace vo {

/// What a trajectory's axes were found to be.
struct FoundAxes {
  BodyAxes body = BodyAxes::kNone;
  GroundPlane ground = GroundPlane::kUnknown;
};

/// Finds out how the axes of a trajectory lie. People, cars and robots move forward: of the body's axes the
/// one that points along the path is its forward one, z a camera's and x a vehicle's, and with it up is known
/// (-y or z), whose mean over the walk says which of the world's axes is up. Where the orientations do not
/// follow the path (all equal, a camera that looks aside), the world is the one whose path is flat, of which
/// y or z has less than a tenth of the other's extent, if there is one. A body that does not move is taken to
/// have retrace's own axes. O(poses).
FoundAxes find_axes(std::span<const Pose3> poses);

}  // namespace vo
