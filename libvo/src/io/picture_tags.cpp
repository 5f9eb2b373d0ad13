#include "vo/io/picture_tags.hpp"

#include "vo/base/error.hpp"
#include "vo/base/iso_time.hpp"

#include <cmath>
#include <exiv2/exiv2.hpp>
#include <fstream>
#include <stdexcept>

namespace vo {
namespace {

constexpr double kSecond = 1;

std::optional<std::string> text_of(const Exiv2::ExifData& data, const char* key) {
  const auto found = data.findKey(Exiv2::ExifKey(key));
  if (found == data.end() || found->count() == 0) return std::nullopt;
  std::string text = found->toString();
  while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.pop_back();
  return text;
}

/// EXIF writes 2024:05:31 12:00:00, which becomes ISO 8601 with the fraction and the zone from their own
/// tags.
void take_time(const Exiv2::ExifData& data, PictureTags& tags) {
  constexpr std::size_t kDateEnd = 10, kLength = 19;
  auto written = text_of(data, "Exif.Photo.DateTimeOriginal");
  if (!written) written = text_of(data, "Exif.Image.DateTime");
  if (!written || written->size() != kLength) return;
  for (const std::size_t at : {std::size_t{4}, std::size_t{7}}) (*written)[at] = '-';
  (*written)[kDateEnd] = 'T';
  const auto fraction = text_of(data, "Exif.Photo.SubSecTimeOriginal");
  const bool digits =
      fraction && !fraction->empty() && fraction->find_first_not_of("0123456789") == std::string::npos;
  if (digits) *written += "." + *fraction;
  const auto zone = text_of(data, "Exif.Photo.OffsetTimeOriginal");
  if (zone) {
    tags.time_s = parse_iso_time(*written + *zone);
    tags.utc = tags.time_s.has_value();
  }
  if (!tags.time_s) tags.time_s = parse_iso_time(*written);
}

/// Degrees, minutes and seconds as three fractions, and the side as a letter.
std::optional<double> angle_deg(const Exiv2::ExifData& data, const char* key, const char* side_key,
                                char negative, double most_deg) {
  const auto found = data.findKey(Exiv2::ExifKey(key));
  const auto side = text_of(data, side_key);
  constexpr int kParts = 3;
  if (found == data.end() || found->count() != kParts || !side || side->empty()) return std::nullopt;
  double angle = 0, unit = 1;
  for (int i = 0; i < kParts; ++i, unit *= 60) {
    const Exiv2::Rational part = found->toRational(i);
    if (part.second == 0) return std::nullopt;
    angle += static_cast<double>(part.first) / static_cast<double>(part.second) / unit;
  }
  if (!(angle >= 0 && angle <= most_deg)) return std::nullopt;
  return side->front() == negative ? -angle : angle;
}

void take_position(const Exiv2::ExifData& data, PictureTags& tags) {
  const auto latitude = angle_deg(data, "Exif.GPSInfo.GPSLatitude", "Exif.GPSInfo.GPSLatitudeRef", 'S', 90);
  const auto longitude =
      angle_deg(data, "Exif.GPSInfo.GPSLongitude", "Exif.GPSInfo.GPSLongitudeRef", 'W', 180);
  if (latitude && longitude) tags.position_deg = {*latitude, *longitude};
}

}  // namespace

PictureTags read_picture_tags(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path) || !std::ifstream(path))
    throw Error(path.string(), "cannot be read", "a picture");
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);  // damaged tags are left out here, not printed
  PictureTags tags;
  try {
    const auto picture = Exiv2::ImageFactory::open(path.string(), false);
    picture->readMetadata();
    take_time(picture->exifData(), tags);
    take_position(picture->exifData(), tags);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // damaged data: what was read before is used
  }
  return tags;
}

std::vector<double> picture_times_s(const std::vector<std::string>& files,
                                    const std::vector<PictureTags>& tags) {
  if (files.size() != tags.size())
    throw std::invalid_argument("picture_times_s: tags for each file expected");
  constexpr const char* kExpected = "pictures that all have one, in the order of their names";
  std::vector<double> times_s;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!tags[i].time_s) throw Error(files[i], "has no time in its EXIF data", kExpected);
    if (i > 0 && *tags[i].time_s < *tags[i - 1].time_s)
      throw Error(files[i], "was taken before the picture in front of it, by its EXIF data", kExpected);
    times_s.push_back(*tags[i].time_s - *tags[0].time_s);
  }
  for (std::size_t begin = 0, end = 0; begin < times_s.size(); begin = end) {
    end = begin + 1;
    while (end < times_s.size() && times_s[end] == times_s[begin]) ++end;
    const double until_s =
        end < times_s.size() ? std::min(times_s[end], times_s[begin] + kSecond) : times_s[begin] + kSecond;
    const double interval_s = (until_s - times_s[begin]) / static_cast<double>(end - begin);
    for (std::size_t i = begin + 1; i < end; ++i)
      times_s[i] = times_s[begin] + interval_s * static_cast<double>(i - begin);
  }
  return times_s;
}

}  // namespace vo
