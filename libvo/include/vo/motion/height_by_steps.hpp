#pragma once

#include "vo/motion/displacement_track.hpp"

#include <optional>
#include <span>

namespace vo {

/// How high above the ground steps would have the camera, metres: the ground's height in the unit of a track
/// (`ground_height`), times the metres that the steps give to that unit. Steps that a car's bounce looks like
/// are far too short for its way, and so bring the camera down to the ground.
///
/// `steps_m`: displacement by steps, one for each frame of the track. By the segment in which most was
/// walked; none where nothing was, or no ground is seen. Throws `std::invalid_argument` for other sizes.
/// O(frames + heights^2).
std::optional<double> height_by_steps_m(const DisplacementTrack& track, std::span<const double> steps_m);

}  // namespace vo
