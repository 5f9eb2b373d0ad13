#include "place/route/geographic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>

namespace place {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

/// Metres of a degree to the north and to the east at a latitude: the ellipsoid's radii of curvature.
struct DegreeLength {
  double north_m, east_m;
};

DegreeLength degree_length(double latitude_deg) {
  if (!(std::abs(latitude_deg) <= 89))
    throw std::invalid_argument("geographic: latitudes up to 89 degrees expected");
  constexpr double kEquator_m = 6378137, kFlattening = 1 / 298.257223563;  // WGS 84
  constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
  const double s = std::sin(latitude_deg * kRadPerDeg);
  const double w2 = 1 - kEccentricity2 * s * s;
  const double normal_m = kEquator_m / std::sqrt(w2);
  return {normal_m * (1 - kEccentricity2) / w2 * kRadPerDeg,
          normal_m * std::cos(latitude_deg * kRadPerDeg) * kRadPerDeg};
}

/// The value of an attribute in a tag; none if it has none.
std::optional<double> attribute(std::string_view tag, std::string_view name) {
  const std::string start = fmt::format(" {}=", name);
  const std::size_t at = tag.find(start);
  if (at == std::string_view::npos || at + start.size() + 1 >= tag.size()) return std::nullopt;
  const char quote = tag[at + start.size()];
  const std::size_t begin = at + start.size() + 1, end = tag.find(quote, begin);
  if (end == std::string_view::npos) return std::nullopt;
  const std::string text(tag.substr(begin, end - begin));
  char* rest = nullptr;
  const double value = std::strtod(text.c_str(), &rest);
  if (text.empty() || *rest != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Seconds since 1970 of an ISO 8601 time in UTC, as GPX has them; none if it is none.
std::optional<double> utc_s(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0;
  if (std::sscanf(text.c_str(), "%d-%d-%dT%d:%d:%lf", &year, &month, &day, &hour, &minute, &second) != 6)
    return std::nullopt;
  // Days of the proleptic Gregorian calendar, years begun in March.
  const int y = year - (month <= 2 ? 1 : 0);
  const int leap = (y / 4) - (y / 100) + (y / 400);
  const int days = 365 * y + leap + (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 719469;
  return 86400.0 * days + 3600.0 * hour + 60.0 * minute + second;
}

GeographicTrack read_gpx(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw vo::Error(path.string(), "cannot be read", "a GPX file");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  GeographicTrack track;
  double first_s = 0;
  for (std::size_t at = text.find("<trkpt"); at != std::string::npos; at = text.find("<trkpt", at + 1)) {
    const std::string where = fmt::format("{}: track point {}", path.string(), track.points.size() + 1);
    const std::size_t close = std::min({text.find("</trkpt>", at), text.find("<trkpt", at + 1), text.size()});
    const std::string_view point = std::string_view(text).substr(at, close - at);
    const auto latitude = attribute(point, "lat"), longitude = attribute(point, "lon");
    if (!latitude || !longitude) throw vo::Error(where, "has no place", "lat=\"...\" lon=\"...\", degrees");
    const std::size_t begin = point.find("<time>"), end = point.find("</time>");
    const auto time_s = begin < end && end != std::string_view::npos
                            ? utc_s(std::string(point.substr(begin + 6, end - begin - 6)))
                            : std::nullopt;
    if (!time_s) throw vo::Error(where, "has no time", "<time>2024-05-31T12:00:00Z</time>");
    if (track.points.empty()) first_s = *time_s;
    track.time_s.push_back(*time_s - first_s);
    track.points.push_back({*latitude, *longitude});
  }
  return track;
}

GeographicTrack read_csv(const std::filesystem::path& path) {
  const vo::CsvTable table = vo::CsvTable::read(path);
  const auto latitude_deg = table.numbers(table.has("lat_deg") ? "lat_deg" : "latitude_deg");
  const auto longitude_deg = table.numbers(table.has("lon_deg") ? "lon_deg" : "longitude_deg");
  GeographicTrack track{.time_s = table.numbers("time_s"), .points = {}};
  for (std::size_t i = 0; i < table.rows(); ++i) track.points.push_back({latitude_deg[i], longitude_deg[i]});
  return track;
}

}  // namespace

vo::Pose2 local_at(const GeographicOrigin& origin, const GeographicPoint& point) {
  const auto [north_m, east_m] = degree_length(origin.latitude_deg);
  const double east_deg = std::remainder(point.longitude_deg - origin.longitude_deg, 360);
  return {east_deg * east_m, (point.latitude_deg - origin.latitude_deg) * north_m, 0};
}

GeographicPoint geographic_at(const GeographicOrigin& origin, double x_m, double y_m) {
  const auto [north_m, east_m] = degree_length(origin.latitude_deg);
  return {origin.latitude_deg + y_m / north_m, std::remainder(origin.longitude_deg + x_m / east_m, 360)};
}

GeographicTrack read_track(const std::filesystem::path& path) {
  GeographicTrack track = path.extension() == ".gpx" ? read_gpx(path) : read_csv(path);
  if (track.points.size() < 2)
    throw vo::Error(path.string(), fmt::format("has {} points", track.points.size()),
                    "a track of two points or more");
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const auto& [latitude, longitude] = track.points[i];
    if (!(std::abs(latitude) <= 89 && std::abs(longitude) <= 360)) {
      throw vo::Error(path.string(), fmt::format("point {} is at {}, {}", i + 1, latitude, longitude),
                      "degrees, latitudes up to 89");
    }
    if (i > 0 && !(track.time_s[i] > track.time_s[i - 1])) {
      throw vo::Error(path.string(), fmt::format("point {} is not later than the one before", i + 1),
                      "strictly increasing times");
    }
  }
  return track;
}

vo::Trajectory local_trajectory(const GeographicTrack& track, const GeographicOrigin& origin,
                                double heading_m) {
  vo::Trajectory trajectory;
  for (std::size_t i = 0; i < track.points.size(); ++i)
    trajectory.push_back({track.time_s[i], local_at(origin, track.points[i])});
  // Each heading is that from the last point at least half of heading_m behind to the first as far ahead.
  const auto away_m = [&](std::size_t a, std::size_t b) {
    return std::hypot(trajectory[a].pose.x_m - trajectory[b].pose.x_m,
                      trajectory[a].pose.y_m - trajectory[b].pose.y_m);
  };
  double heading_rad = 0;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    std::size_t from = i, to = i;
    while (from > 0 && away_m(from, i) < heading_m / 2) --from;
    while (to + 1 < trajectory.size() && away_m(to, i) < heading_m / 2) ++to;
    const vo::Pose2 &a = trajectory[from].pose, &b = trajectory[to].pose;
    if (away_m(from, to) > 0) heading_rad = std::atan2(b.x_m - a.x_m, b.y_m - a.y_m);
    trajectory[i].pose.heading_rad = heading_rad;
  }
  return trajectory;
}

std::string to_geojson(const vo::Trajectory& trajectory, const GeographicOrigin& origin) {
  std::string line, times;
  for (const auto& [time_s, pose] : trajectory) {
    const GeographicPoint p = geographic_at(origin, pose.x_m, pose.y_m);
    line += fmt::format("{}[{:.7f},{:.7f}]", line.empty() ? "" : ",", p.longitude_deg, p.latitude_deg);
    times += fmt::format("{}{:.3f}", times.empty() ? "" : ",", time_s);
  }
  return fmt::format(
      R"({{"type":"Feature","properties":{{"time_s":[{}]}},"geometry":{{"type":"LineString","coordinates":[{}]}}}})"
      "\n",
      times, line);
}

std::string to_gpx(const vo::Trajectory& trajectory, const GeographicOrigin& origin) {
  std::string gpx =
      R"(<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="retrace" xmlns="http://www.topografix.com/GPX/1/1">
<trk><trkseg>
)";
  for (const auto& [time_s, pose] : trajectory) {
    const GeographicPoint p = geographic_at(origin, pose.x_m, pose.y_m);
    gpx += fmt::format("<trkpt lat=\"{:.7f}\" lon=\"{:.7f}\"></trkpt>\n", p.latitude_deg, p.longitude_deg);
  }
  return gpx + "</trkseg></trk>\n</gpx>\n";
}

}  // namespace place
