#pragma once

#include "place/route/route.hpp"

#include <optional>
#include <span>
#include <string>

#include <vo/base/trajectory.hpp>

namespace place {

/// A place on the earth, WGS 84.
struct GeographicPoint {
  double latitude_deg = 0;
  double longitude_deg = 0;
};

/// Metres east and north of the origin, on the plane that touches the ellipsoid there; over a walk's few
/// kilometres within a few metres of distances on the ground, and the exact inverse of `geographic_at`.
/// Throws `std::invalid_argument` for latitudes beyond 89 degrees.
vo::Pose2 local_at(const GeographicOrigin& origin, const GeographicPoint& point);
GeographicPoint geographic_at(const GeographicOrigin& origin, double x_m, double y_m);

/// The probability that each pose of a trajectory is right, none where it is not known; empty: not given.
using PoseProbabilities = std::span<const std::optional<double>>;

/// A line as GeoJSON (RFC 7946), with the points' times as property `time_s`, and their probabilities, if
/// given, as `probability`. Coordinates to a centimetre. Throws `std::invalid_argument` for another number of
/// probabilities than poses.
std::string to_geojson(const vo::Trajectory& trajectory, const GeographicOrigin& origin,
                       PoseProbabilities probability = {});

/// A track of GPX 1.1, to a centimetre and a millisecond, which `read_track` reads. `start_utc_s`: when the
/// walk began, in seconds since 1970; without it times count from 1970 itself, and the file says so.
/// Probabilities become an extension of each point. Throws as `to_geojson`.
std::string to_gpx(const vo::Trajectory& trajectory, const GeographicOrigin& origin,
                   std::optional<double> start_utc_s = std::nullopt, PoseProbabilities probability = {});

}  // namespace place
