#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vo {

/// What a picture's EXIF data say of when and where it was taken.
struct PictureTags {
  /// Seconds since 1970 by the camera's clock, local time taken for UTC where no zone is given; with the
  /// fraction of a second that newer cameras note.
  std::optional<double> time_s;
  bool utc = false;                                       ///< whether the time's zone is known
  std::optional<std::pair<double, double>> position_deg;  ///< latitude, longitude
};

/// Reads the EXIF data of a picture (JPEG, TIFF, PNG, WebP; by Exiv2): DateTimeOriginal with
/// SubSecTimeOriginal and OffsetTimeOriginal, GPSLatitude and GPSLongitude. What is missing or damaged has no
/// value. Throws `vo::Error` naming the file if it cannot be read. Reads the head of the file; well under a
/// millisecond.
PictureTags read_picture_tags(const std::filesystem::path& path);

/// Seconds since the first picture by the pictures' own clocks, one for each; strictly increasing. Where
/// pictures share a second, as clocks without fractions give it, they are spread evenly over that second, or
/// over the time to the next picture if that is shorter. `files`: of one walk, in order. Throws `vo::Error`
/// naming the first picture that has no time or was taken before the one in front of it. O(files).
std::vector<double> picture_times_s(const std::vector<std::string>& files,
                                    const std::vector<PictureTags>& tags);

}  // namespace vo
