#include "vo/io/video_positions.hpp"

#include "io/gpmf.hpp"
#include "io/gpmf_track.hpp"

#include <span>

namespace vo {
namespace {

/// The positions of a piece, evenly over [begin_s, end_s).
void spread(std::span<const GpmfPosition> piece, double begin_s, double end_s, VideoPositions& all) {
  const double interval_s = (end_s - begin_s) / static_cast<double>(piece.size());
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (!piece[i].fix) {
      ++all.without_fix;
      continue;
    }
    all.positions.push_back({.time_s = begin_s + interval_s * static_cast<double>(i),
                             .latitude_deg = piece[i].latitude_deg,
                             .longitude_deg = piece[i].longitude_deg});
  }
}

}  // namespace

VideoPositions read_video_positions(const std::filesystem::path& path) {
  VideoPositions all;
  visit_gpmf_pieces(path,
                    {.missing = "has no GPS track",
                     .expected = "a GoPro's .mp4 with the GPS switched on, or a GPX or CSV file"},
                    [&](const GpmfPiece& piece) {
                      const auto positions = gpmf_positions(piece.bytes);
                      if (!positions) ++all.damaged;
                      if (positions && !positions->empty())
                        spread(*positions, piece.begin_s, piece.end_s, all);
                    });
  return all;
}

}  // namespace vo
