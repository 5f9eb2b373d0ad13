#include "place/route/geographic.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/degrees.hpp>
#include <vo/base/iso_time.hpp>

namespace place {
namespace {

/// Metres of a degree to the north and to the east at a latitude: the ellipsoid's radii of curvature.
struct DegreeLength {
  double north_m, east_m;
};

DegreeLength degree_length(double latitude_deg) {
  if (!(std::abs(latitude_deg) <= 89))
    throw std::invalid_argument("geographic: latitudes up to 89 degrees expected");
  constexpr double kEquator_m = 6378137, kFlattening = 1 / 298.257223563;  // WGS 84
  constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
  const double s = std::sin(latitude_deg * vo::kRadPerDeg);
  const double w2 = 1 - kEccentricity2 * s * s;
  const double normal_m = kEquator_m / std::sqrt(w2);
  return {normal_m * (1 - kEccentricity2) / w2 * vo::kRadPerDeg,
          normal_m * std::cos(latitude_deg * vo::kRadPerDeg) * vo::kRadPerDeg};
}

void check(const vo::Trajectory& trajectory, PoseProbabilities probability) {
  if (!probability.empty() && probability.size() != trajectory.size())
    throw std::invalid_argument("geographic: a probability for each pose expected");
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

std::string to_geojson(const vo::Trajectory& trajectory, const GeographicOrigin& origin,
                       PoseProbabilities probability) {
  check(trajectory, probability);
  std::string line, times, probabilities;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const auto& [time_s, pose] = trajectory[i];
    const char* comma = i == 0 ? "" : ",";
    const GeographicPoint p = geographic_at(origin, pose.x_m, pose.y_m);
    line += fmt::format("{}[{:.7f},{:.7f}]", comma, p.longitude_deg, p.latitude_deg);
    times += fmt::format("{}{:.3f}", comma, time_s);
    if (!probability.empty())
      probabilities += comma + (probability[i] ? fmt::format("{:.4f}", *probability[i]) : "null");
  }
  if (!probability.empty()) probabilities = fmt::format(R"(,"probability":[{}])", probabilities);
  return fmt::format(
      R"({{"type":"Feature","properties":{{"time_s":[{}]{}}},"geometry":{{"type":"LineString","coordinates":[{}]}}}})"
      "\n",
      times, probabilities, line);
}

std::string to_gpx(const vo::Trajectory& trajectory, const GeographicOrigin& origin,
                   std::optional<double> start_utc_s, PoseProbabilities probability) {
  check(trajectory, probability);
  std::string gpx = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  gpx += fmt::format(R"(<gpx version="1.1" creator="retrace" xmlns="http://www.topografix.com/GPX/1/1"{}>)",
                     probability.empty() ? "" : R"( xmlns:retrace="urn:retrace:gpx")");
  gpx += '\n';
  if (!start_utc_s) gpx += "<metadata><desc>Times count from the walk's first frame.</desc></metadata>\n";
  gpx += "<trk><trkseg>\n";
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const auto& [time_s, pose] = trajectory[i];
    const GeographicPoint p = geographic_at(origin, pose.x_m, pose.y_m);
    std::string extension;
    if (!probability.empty() && probability[i])
      extension = fmt::format("<extensions><retrace:probability>{:.4f}</retrace:probability></extensions>",
                              *probability[i]);
    gpx += fmt::format("<trkpt lat=\"{:.7f}\" lon=\"{:.7f}\"><time>{}</time>{}</trkpt>\n", p.latitude_deg,
                       p.longitude_deg, vo::iso_time(start_utc_s.value_or(0) + time_s), extension);
  }
  return gpx + "</trkseg></trk>\n</gpx>\n";
}

}  // namespace place
