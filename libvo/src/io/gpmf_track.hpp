#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

namespace vo {

/// A piece of a video's telemetry, and when it was recorded: seconds since the first frame.
struct GpmfPiece {
  std::span<const std::uint8_t> bytes;
  double begin_s = 0, end_s = 0;
};

/// What a reader of telemetry says of a video that has none.
struct GpmfWanted {
  const char* missing;   ///< "has no GPS track"
  const char* expected;  ///< what the file should have been
};

/// Calls `visit` for every piece of the track called `gpmd`, in the order of the file. Throws `Error` naming
/// the file if it is no video or has no such track. Reads the packets of that track alone.
void visit_gpmf_pieces(const std::filesystem::path& path, const GpmfWanted& wanted,
                       const std::function<void(const GpmfPiece&)>& visit);

}  // namespace vo
