#pragma once

#include "place/route/geographic.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <vo/base/trajectory.hpp>

namespace place {

/// A track: places and times.
struct GeographicTrack {
  std::vector<double> time_s;           ///< strictly increasing; for a GPX file, since its first point
  std::vector<GeographicPoint> points;  ///< one for each time
  std::vector<std::size_t> segment;     ///< of each point; nothing is known between two. Empty: all one
  std::optional<double> start_utc_s;    ///< seconds since 1970 at time 0, if the file's clock says so
  std::vector<std::string> warnings;  ///< what a user should know: points left out, other tracks in the file
};

/// Settings of `read_track`.
struct TrackOptions {
  std::string track_name;  ///< track to read from a GPX file, or its number from 1; empty: see below
  std::optional<double> video_start_utc_s;  ///< when the walk began, if its video says so
  double video_duration_s = 0;
  std::vector<double> picture_time_s;  ///< of each picture of a folder whose own positions are read
};

/// Reads a track: a GPX file, recognised by its ending or its first character, a video of a GoPro (.mp4,
/// .mov, .lrv, .360: `vo::read_video_positions`), a folder of pictures with positions in their EXIF data
/// (`vo::read_picture_tags`; pictures without one are left out), or a CSV file with columns time_s
/// (or time, timestamp, in seconds or ISO 8601), latitude_deg (or lat_deg, latitude, lat) and longitude_deg
/// (or lon_deg, longitude, lon, lng). Times of the last three are since the first frame; those of a CSV file
/// in milliseconds or finer are converted (`vo::time_unit`), and if they count from 1970, they are since its
/// first point.
///
/// In a GPX file every `trkpt` with a place and a time counts, in any encoding, name space prefix or time
/// zone; segments are sorted by time. Points without place (0, 0 is none) or time, out of order within a
/// segment, or with a repeated time are left out and counted in `warnings`, as is a file that is cut off. Of
/// several tracks, the one asked for by name is read, otherwise the one with most time during the video,
/// otherwise the latest; a warning names them. A file that counts from 1970 (`to_gpx` without a start) has
/// times since the walk's first frame.
///
/// Throws `vo::Error` naming the file if it is none of these, has no track (a route, waypoints), no track
/// with that name, or fewer than two usable points. O(n log n).
GeographicTrack read_track(const std::filesystem::path& path, const TrackOptions& options = {});

/// The track as poses relative to an origin; heading is that of the path over `heading_m` metres, so that the
/// receiver's noise does not affect it (`vo::head_along_path`), for each segment separately. O(n).
vo::Trajectory local_trajectory(const GeographicTrack& track, const GeographicOrigin& origin,
                                double heading_m = vo::kPathHeading_m);

}  // namespace place
