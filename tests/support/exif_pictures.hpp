#pragma once

#include "support/gpmf_pieces.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>

namespace test_support {

/// EXIF data as a camera writes them into a JPEG: TIFF directories, big-endian [Exif 2.32, section 4.6].
struct Exif {
  std::string time;      ///< 2024:05:31 12:00:00, or empty
  std::string fraction;  ///< digits after the second's point, or empty
  std::string zone;      ///< +02:00, or empty
  std::optional<LatLon> position_deg;
};

struct ExifEntry {
  int tag, type;  ///< type 2: text, 4: 32 bits, 5: fraction
  std::string data;
};

/// A directory that begins at an offset of the TIFF data, its long values behind it.
inline std::string exif_directory(const std::vector<ExifEntry>& entries, std::size_t begin) {
  std::string head = big_endian(static_cast<std::int64_t>(entries.size()), 2), values;
  const std::size_t values_at = begin + 2 + 12 * entries.size() + 4;
  for (const ExifEntry& entry : entries) {
    const std::size_t unit = entry.type == 2 ? 1 : entry.type == 4 ? 4 : 8;
    head += big_endian(entry.tag, 2) + big_endian(entry.type, 2) +
            big_endian(static_cast<std::int64_t>(entry.data.size() / unit), 4);
    if (entry.data.size() <= 4) {
      head += entry.data + std::string(4 - entry.data.size(), '\0');
    } else {
      head += big_endian(static_cast<std::int64_t>(values_at + values.size()), 4);
      values += entry.data + std::string(entry.data.size() % 2, '\0');
    }
  }
  return head + big_endian(0, 4) + values;
}

/// An angle as degrees, minutes, and hundred-thousandths of a second.
inline std::string exif_angle(double deg) {
  const double all_s = std::abs(deg) * 3600;
  const auto whole = static_cast<std::int64_t>(all_s / 60);
  const auto rest = static_cast<std::int64_t>(std::llround((all_s - static_cast<double>(whole) * 60) * 1e5));
  return big_endian(whole / 60, 4) + big_endian(1, 4) + big_endian(whole % 60, 4) + big_endian(1, 4) +
         big_endian(rest, 4) + big_endian(100000, 4);
}

inline std::string exif_data(const Exif& exif) {
  constexpr std::size_t kFirst = 8;  // behind TIFF's head
  std::vector<ExifEntry> photo, gps;
  if (!exif.time.empty()) photo.push_back({0x9003, 2, exif.time + '\0'});
  if (!exif.zone.empty()) photo.push_back({0x9011, 2, exif.zone + '\0'});
  if (!exif.fraction.empty()) photo.push_back({0x9291, 2, exif.fraction + '\0'});
  if (exif.position_deg) {
    const auto& [latitude, longitude] = *exif.position_deg;
    gps = {{1, 2, std::string(latitude < 0 ? "S" : "N") + '\0'},
           {2, 5, exif_angle(latitude)},
           {3, 2, std::string(longitude < 0 ? "W" : "E") + '\0'},
           {4, 5, exif_angle(longitude)}};
  }
  const std::size_t photo_at = kFirst + 2 + 12 * 2 + 4;
  const std::string photo_part = exif_directory(photo, photo_at);
  const std::size_t gps_at = photo_at + photo_part.size();
  const std::string root = exif_directory({{0x8769, 4, big_endian(static_cast<std::int64_t>(photo_at), 4)},
                                           {0x8825, 4, big_endian(static_cast<std::int64_t>(gps_at), 4)}},
                                          kFirst);
  return std::string("MM") + big_endian(42, 2) + big_endian(kFirst, 4) + root + photo_part +
         exif_directory(gps, gps_at);
}

/// Writes a JPEG picture with EXIF data.
inline void write_exif_picture(const std::filesystem::path& path, const cv::Mat& picture, const Exif& exif) {
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", picture, jpeg);
  const std::string body = std::string("Exif") + '\0' + '\0' + exif_data(exif);
  const std::string segment = "\xFF\xE1" + big_endian(static_cast<std::int64_t>(body.size()) + 2, 2) + body;
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(jpeg.data()), 2);
  file << segment;
  file.write(reinterpret_cast<const char*>(jpeg.data()) + 2, static_cast<std::streamsize>(jpeg.size()) - 2);
}

}  // namespace test_support
