#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace test_support {

/// Pieces of GoPro's telemetry, for tests: entries of GPMF.
inline std::string big_endian(std::int64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i)
    text += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFF);
  return text;
}

inline std::string gpmf_entry(const std::string& key, char type, int value_size, const std::string& data) {
  std::string entry = key + type + static_cast<char>(value_size);
  entry += big_endian(static_cast<std::int64_t>(data.size()) / value_size, 2) + data;
  while (entry.size() % 4 != 0) entry += '\0';
  return entry;
}

inline std::string gpmf_container(const std::string& key, const std::string& entries) {
  return gpmf_entry(key, '\0', 1, entries);
}

using LatLon = std::pair<double, double>;

/// A piece of a camera's device with a stream of something else, and one of positions (GPS5), in degrees.
inline std::string gps5_piece(const std::vector<LatLon>& positions, int fix = 3) {
  std::string values;
  for (const auto& [latitude, longitude] : positions) {
    values += big_endian(static_cast<std::int64_t>(latitude * 1e7 + (latitude < 0 ? -0.5 : 0.5)), 4);
    values += big_endian(static_cast<std::int64_t>(longitude * 1e7 + (longitude < 0 ? -0.5 : 0.5)), 4);
    values += big_endian(31000, 4) + big_endian(1300, 4) + big_endian(130, 4);
  }
  const std::string scales = big_endian(10000000, 4) + big_endian(10000000, 4) + big_endian(1000, 4) +
                             big_endian(1000, 4) + big_endian(100, 4);
  const std::string other = gpmf_container("STRM", gpmf_entry("SCAL", 's', 2, big_endian(418, 2)) +
                                                       gpmf_entry("ACCL", 's', 6, std::string(18, 'x')));
  const std::string gps =
      gpmf_container("STRM", gpmf_entry("GPSF", 'L', 4, big_endian(fix, 4)) +
                                 gpmf_entry("SCAL", 'l', 4, scales) + gpmf_entry("GPS5", 'l', 20, values));
  return gpmf_container("DEVC", gpmf_entry("DVNM", 'c', 1, "Camera") + other + gps);
}

/// A piece with accelerations along the camera's axes, m/s^2, to 1/418 of it (as a HERO has them).
inline std::string accl_piece(const std::vector<std::array<double, 3>>& accelerations) {
  constexpr double kScale = 418;
  std::string values;
  for (const auto& acceleration : accelerations)
    for (const double along : acceleration) values += big_endian(std::lround(along * kScale), 2);
  return gpmf_container("DEVC", gpmf_container("STRM", gpmf_entry("SCAL", 's', 2, big_endian(418, 2)) +
                                                           gpmf_entry("ACCL", 's', 6, values)));
}

}  // namespace test_support
