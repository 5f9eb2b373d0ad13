#include "place/route/named_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/text_file.hpp>

namespace place {
namespace {

constexpr const char* kExpected = "the columns frame,name or distance_m,name";

/// True for text that is UTF-8, without overlong forms and surrogates.
bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned first = byte(i);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xC2 ? 0
                               : first < 0xE0 ? 2
                               : first < 0xF0 ? 3
                               : first < 0xF5 ? 4
                                              : 0;
    if (length == 0 || i + length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k)
      if ((byte(i + k) & 0xC0U) != 0x80U) return false;
    if (first == 0xE0 && byte(i + 1) < 0xA0) return false;
    if (first == 0xED && byte(i + 1) > 0x9F) return false;
    if (first == 0xF0 && byte(i + 1) < 0x90) return false;
    if (first == 0xF4 && byte(i + 1) > 0x8F) return false;
    i += length;
  }
  return true;
}

void check_name(const PlaceName& place) {
  constexpr std::size_t kLongest = 200;  // bytes; it is read out while walking
  if (place.name.empty()) throw vo::Error(place.where, "has no name", "a name for each place");
  if (!is_utf8(place.name)) throw vo::Error(place.where, "has a name that is not UTF-8", "a file in UTF-8");
  if (std::ranges::any_of(place.name, [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
    throw vo::Error(place.where, "has a name with control characters", "plain text");
  if (place.name.size() > kLongest)
    throw vo::Error(place.where, fmt::format("has a name of {} bytes", place.name.size()),
                    fmt::format("at most {}", kLongest));
}

/// `to` where `from`, which does not decrease, reaches `value`; none outside its range.
std::optional<double> interpolated(const std::vector<double>& from, const std::vector<double>& to,
                                   double value) {
  if (from.empty() || value < from.front() || value > from.back()) return {};
  const auto after = static_cast<std::size_t>(std::ranges::lower_bound(from, value) - from.begin());
  if (after == 0) return to.front();
  const double span = from[after] - from[after - 1];
  return span > 0 ? std::lerp(to[after - 1], to[after], (value - from[after - 1]) / span) : to[after];
}

/// Frames and distances of the keyframes that are surveyed.
struct Surveyed {
  std::vector<double> frame, distance_m;
};

Surveyed surveyed(const Traverse& traverse) {
  Surveyed columns;
  for (const Keyframe& keyframe : traverse.keyframes) {
    if (!keyframe.distance_m) continue;
    columns.frame.push_back(static_cast<double>(keyframe.frame));
    // Distance that goes back, by an error of the survey, is none.
    const double before = columns.distance_m.empty() ? *keyframe.distance_m : columns.distance_m.back();
    columns.distance_m.push_back(std::max(before, *keyframe.distance_m));
  }
  return columns;
}

/// A frame's position among the keyframes, held to the ends.
double keyframe_at(const Traverse& traverse, double frame) {
  const auto after = std::ranges::lower_bound(traverse.keyframes, frame, {},
                                              [](const Keyframe& k) { return static_cast<double>(k.frame); });
  const auto index = static_cast<std::size_t>(after - traverse.keyframes.begin());
  if (index == 0) return 0;
  if (index == traverse.keyframes.size()) return static_cast<double>(index - 1);
  const auto low = static_cast<double>(traverse.keyframes[index - 1].frame),
             high = static_cast<double>(traverse.keyframes[index].frame);
  return static_cast<double>(index - 1) + (frame - low) / (high - low);
}

double distance_between_m(const vo::Pose2& a, const vo::Pose2& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

/// The keyframe that is nearest to a pose.
struct NearestKeyframe {
  std::size_t keyframe = 0;
  double away_m = std::numeric_limits<double>::infinity();
};

NearestKeyframe nearest_to(const Traverse& traverse, const vo::Pose2& pose) {
  NearestKeyframe nearest;
  for (std::size_t k = 0; k < traverse.keyframes.size(); ++k) {
    const std::optional<vo::Pose2>& at = traverse.keyframes[k].pose;
    if (!at) continue;
    const double away_m = distance_between_m(*at, pose);
    if (away_m < nearest.away_m) nearest = {k, away_m};
  }
  return nearest;
}

}  // namespace

std::vector<PlaceName> read_place_names(const std::filesystem::path& path) {
  const vo::CsvTable table = vo::CsvTable::read(path);
  const bool by_frame = table.has("frame"), by_distance = table.has("distance_m");
  if (!table.has("name") || by_frame == by_distance) {
    std::string header;
    for (const std::string_view column : table.header())
      header.append(header.empty() ? "" : ",").append(column);
    throw vo::Error(path.string(), fmt::format("has the columns {}", vo::printable(header)), kExpected);
  }
  if (table.rows() == 0) throw vo::Error(path.string(), "names no place", "a row for each place");
  const std::vector<std::string> name = table.text("name");
  std::vector<PlaceName> names(table.rows());
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = {name[i], {}, {}, table.where(i)};
  if (by_frame) {
    const std::vector<std::int64_t> frame = table.indices("frame");
    for (std::size_t i = 0; i < names.size(); ++i) names[i].frame = frame[i];
  } else {
    const std::vector<double> distance_m = table.numbers("distance_m");
    for (std::size_t i = 0; i < names.size(); ++i) names[i].distance_m = distance_m[i];
  }
  for (const PlaceName& place : names) check_name(place);
  return names;
}

std::vector<NamedPlace> named_places(const std::vector<PlaceName>& names, const Traverse& traverse) {
  const Surveyed along = surveyed(traverse);
  std::vector<NamedPlace> places;
  for (const PlaceName& name : names) {
    NamedPlace place{.name = name.name, .frame = name.frame.value_or(0), .distance_m = name.distance_m};
    if (name.frame) {
      if (*name.frame >= traverse.frames)
        throw vo::Error(name.where, fmt::format("names frame {}", *name.frame),
                        fmt::format("0 to {}, the frames of {}", traverse.frames - 1, traverse.source));
      place.distance_m = interpolated(along.frame, along.distance_m, static_cast<double>(*name.frame));
    } else {
      if (along.frame.empty())
        throw vo::Error(name.where, "gives a distance, and the walk has no surveyed distances",
                        "the column frame, or a survey (--truth, --trajectory, --track)");
      const std::optional<double> frame = interpolated(along.distance_m, along.frame, *name.distance_m);
      if (!frame)
        throw vo::Error(
            name.where, fmt::format("names the place at {:g} m", *name.distance_m),
            fmt::format("{:g} to {:g} m, as surveyed", along.distance_m.front(), along.distance_m.back()));
      place.frame = std::llround(*frame);
    }
    places.push_back(std::move(place));
  }
  std::ranges::stable_sort(places, {}, &NamedPlace::frame);
  return places;
}

std::vector<PlaceOnTraverse> places_on(const Route& route, std::size_t traverse) {
  constexpr double kAside_m = 3, kSame_m = 10;
  const Traverse& on = route.traverses[traverse];
  std::vector<PlaceOnTraverse> all;
  for (std::size_t t = 0; t < route.traverses.size(); ++t) {
    const Traverse& of = route.traverses[t];
    if (of.keyframes.empty()) continue;
    for (std::size_t i = 0; i < of.places.size(); ++i) {
      const double at = keyframe_at(of, static_cast<double>(of.places[i].frame));
      if (t == traverse) {
        all.push_back({t, i, at});
        continue;
      }
      if (of.surveyed != on.surveyed || !of.surveyed) continue;  // odometry begins anew with each walk
      const std::optional<vo::Pose2>& pose = of.keyframes[static_cast<std::size_t>(std::lround(at))].pose;
      if (!pose) continue;
      const NearestKeyframe nearest = nearest_to(on, *pose);
      if (nearest.away_m > kAside_m) continue;
      const bool named = std::ranges::any_of(on.places, [&](const NamedPlace& own) {
        const auto k = static_cast<std::size_t>(std::lround(keyframe_at(on, static_cast<double>(own.frame))));
        return own.name == of.places[i].name && on.keyframes[k].pose &&
               distance_between_m(*on.keyframes[k].pose, *pose) <= kSame_m;
      });
      if (!named) all.push_back({t, i, static_cast<double>(nearest.keyframe)});
    }
  }
  return all;
}

}  // namespace place
