#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// GPMF, the form of GoPro's telemetry: entries of a key of four letters, a type, the size of one value,
/// their number (big-endian, as are the values), and the values, padded to four bytes; type 0 holds entries.
namespace vo {

/// A position as in the file.
struct GpmfPosition {
  double latitude_deg = 0;
  double longitude_deg = 0;
  bool fix = false;  ///< whether the receiver knew where it was
};

/// The positions in one piece of telemetry, in order; none if there are none. No result if the piece is
/// damaged: an entry that is longer than what holds it, positions without a scale, or of another shape.
std::optional<std::vector<GpmfPosition>> gpmf_positions(std::span<const std::uint8_t> piece);

/// The accelerations in one piece (ACCL), m/s^2 along the camera's axes, in order; as `gpmf_positions`.
std::optional<std::vector<std::array<double, 3>>> gpmf_accelerations(std::span<const std::uint8_t> piece);

}  // namespace vo
