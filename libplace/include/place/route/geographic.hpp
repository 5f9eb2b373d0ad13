#pragma once

#include "place/route/route_database.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vo/base/trajectory.hpp>

namespace place {

/// A place on the earth, WGS 84.
struct GeographicPoint {
  double latitude_deg = 0;
  double longitude_deg = 0;
};

/// Metres east and north of the origin, on the plane that touches the ellipsoid there; over a walk's few
/// kilometres within a few metres of the way over the ground, and the exact inverse of `geographic_at`.
/// Throws `std::invalid_argument` for latitudes beyond 89 degrees.
vo::Pose2 local_at(const GeographicOrigin& origin, const GeographicPoint& point);
GeographicPoint geographic_at(const GeographicOrigin& origin, double x_m, double y_m);

/// A track: where one was, and when, seconds since its first point.
struct GeographicTrack {
  std::vector<double> time_s;  ///< strictly increasing
  std::vector<GeographicPoint> points;
};

/// Reads a track: a GPX file, its track points with `lat`, `lon` and a `time`, or a CSV file with columns
/// time_s, latitude_deg (or lat_deg), longitude_deg (or lon_deg), whose times are taken as they are. Throws
/// `vo::Error` naming the file for anything else, fewer than two points, or times that do not increase.
GeographicTrack read_track(const std::filesystem::path& path);

/// The track as poses about an origin, by default its first point; heading is that from point to point, over
/// `heading_m` metres at least, so that the receiver's noise does not turn it. O(n).
vo::Trajectory local_trajectory(const GeographicTrack& track, const GeographicOrigin& origin,
                                double heading_m = 3);

/// A line as GeoJSON (RFC 7946), with the points' times as property `time_s`, or as a track of GPX 1.1, which
/// has no times, as a video does not tell the hour. Coordinates to a centimetre.
std::string to_geojson(const vo::Trajectory& trajectory, const GeographicOrigin& origin);
std::string to_gpx(const vo::Trajectory& trajectory, const GeographicOrigin& origin);

}  // namespace place
