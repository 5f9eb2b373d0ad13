#pragma once

#include <cstddef>
#include <string>

#include <vo/odometry.hpp>

namespace retrace {

/// The steps that the accelerometer of the camera counts on a walk (`--imu`), as a check of those that the
/// pictures show. `source`: "video", the track in the walk's own file. Throws `vo::Error` for another source,
/// a walk that is not one video file, or a video without such a track.
std::size_t imu_steps(const std::string& source, const vo::Walk& walk);

}  // namespace retrace
