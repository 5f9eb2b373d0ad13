#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vo {

/// A position from the GPS receiver of a camera.
struct RecordedPosition {
  double time_s = 0;  ///< since the first frame of the video, on its clock
  double latitude_deg = 0;
  double longitude_deg = 0;
};

/// What a video says about where it was recorded.
struct VideoPositions {
  std::vector<RecordedPosition> positions;  ///< in order of time
  std::size_t without_fix = 0;  ///< positions from before the receiver knew where it was, left out
  std::size_t damaged = 0;      ///< pieces of the track that could not be read
};

/// The positions that GoPro cameras record beside the pictures: the track of an .mp4 called `gpmd`, in GPMF
/// (github.com/gopro/gpmf-parser describes the format), about 1 piece and 10 to 18 positions a second. The
/// positions of a piece are spread evenly over its time; both the older form (GPS5) and the newer (GPS9) are
/// read. Throws `Error` naming the file if it is no video or has no such track. Reads the packets of that
/// track alone; O(file) where the container has no index.
VideoPositions read_video_positions(const std::filesystem::path& path);

}  // namespace vo
