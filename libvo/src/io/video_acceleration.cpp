#include "vo/io/video_acceleration.hpp"

#include "io/gpmf.hpp"
#include "io/gpmf_track.hpp"
#include "vo/base/error.hpp"

#include <cmath>

namespace vo {

VideoAcceleration read_video_acceleration(const std::filesystem::path& path) {
  constexpr GpmfWanted kWanted{.missing = "has no accelerometer track",
                               .expected = "a GoPro's .mp4 as the camera wrote it"};
  VideoAcceleration all;
  visit_gpmf_pieces(path, kWanted, [&](const GpmfPiece& piece) {
    const auto accelerations = gpmf_accelerations(piece.bytes);
    if (!accelerations) ++all.damaged;
    if (!accelerations || accelerations->empty()) return;
    const double interval_s = (piece.end_s - piece.begin_s) / static_cast<double>(accelerations->size());
    for (std::size_t i = 0; i < accelerations->size(); ++i) {
      const auto& [x, y, z] = (*accelerations)[i];
      const double time_s = piece.begin_s + interval_s * static_cast<double>(i);
      if (!all.time_s.empty() && time_s <= all.time_s.back()) continue;  // pieces that overlap by rounding
      all.time_s.push_back(time_s);
      all.acceleration_m_s2.push_back(std::hypot(x, y, z));
    }
  });
  if (all.time_s.empty()) throw Error(path.string(), kWanted.missing, kWanted.expected);
  return all;
}

}  // namespace vo
