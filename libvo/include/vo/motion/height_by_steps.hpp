#pragma once

#include "vo/motion/displacement_track.hpp"

#include <optional>
#include <span>

namespace vo {

/// The camera's height above the ground that the steps imply, metres: its height in the unit of a track
/// (`ground_height`), times the metres that the steps give to that unit. If a car's bounce is mistaken for
/// steps, these are far too short for its distance, and the height comes out near the ground.
///
/// `steps_m`: displacement by steps, one for each frame of the track. Uses the segment with the longest
/// distance; none if nothing was walked or no ground is seen. Throws `std::invalid_argument` for other sizes.
/// O(frames + heights^2).
std::optional<double> height_by_steps_m(const DisplacementTrack& track, std::span<const double> steps_m);

}  // namespace vo
