#include "io/recording_tags.hpp"

#include "vo/base/iso_time.hpp"
#include "vo/io/csv.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace vo {
namespace {

/// The first of the tags that the container or its video stream has.
std::optional<std::string_view> tag(const AVFormatContext& format, const AVStream& stream,
                                    std::initializer_list<const char*> names) {
  for (const char* name : names) {
    for (const AVDictionary* tags : {format.metadata, stream.metadata}) {
      if (const AVDictionaryEntry* entry = av_dict_get(tags, name, nullptr, 0)) return entry->value;
    }
  }
  return std::nullopt;
}

std::optional<double> created_utc_s(const AVFormatContext& format, const AVStream& stream) {
  constexpr double kYear2000 = 946684800;
  const auto dated = tag(format, stream, {"com.apple.quicktime.creationdate", "creation_time"});
  const std::optional<double> time_s = dated ? parse_iso_time(*dated) : std::nullopt;
  return time_s && *time_s >= kYear2000 ? time_s : std::nullopt;
}

}  // namespace

RecordingTags recording_tags(const AVFormatContext& format, const AVStream& stream,
                             std::optional<double> rate_hz) {
  RecordingTags tags{.created_utc_s = created_utc_s(format, stream),
                     .created_at_end = tag(format, stream, {"com.android.version"}).has_value(),
                     .capture_rate_hz = {}};
  const auto text = tag(format, stream, {"com.android.capture.fps"});
  const auto capture = text ? parse_number(*text) : std::nullopt;
  constexpr double kOther = 1.5;
  if (capture && rate_hz && *capture > 0 && (*capture > kOther * *rate_hz || kOther * *capture < *rate_hz))
    tags.capture_rate_hz = capture;
  return tags;
}

double time_scale(double rate_hz, double capture_rate_hz) {
  const bool slow = capture_rate_hz > rate_hz;
  const double ratio = slow ? capture_rate_hz / rate_hz : rate_hz / capture_rate_hz;
  constexpr double kExact = 0.03;
  const double whole = std::round(ratio);
  const double used = std::abs(ratio - whole) <= kExact * ratio ? whole : ratio;
  return slow ? 1 / used : used;
}

}  // namespace vo
