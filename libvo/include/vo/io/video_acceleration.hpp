#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vo {

/// What the accelerometer of a camera recorded.
struct VideoAcceleration {
  std::vector<double> time_s;             ///< since the first frame of the video, strictly increasing
  std::vector<double> acceleration_m_s2;  ///< length of the vector, with gravity, one for each time
  std::size_t damaged = 0;                ///< pieces of the track that could not be read
};

/// The accelerations that GoPro cameras record beside the pictures (see `read_video_positions`), about 200 a
/// second, spread evenly over the time of their piece. Throws `Error` naming the file if it is no video or
/// has no accelerations.
VideoAcceleration read_video_acceleration(const std::filesystem::path& path);

}  // namespace vo
