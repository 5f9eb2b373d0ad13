#pragma once

#include "place/describe/descriptor.hpp"
#include "place/settings.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <vo/base/pose2.hpp>
#include <vo/image/image_stack.hpp>

/// A route as plain data, which `new_route` and `add` fill, `write_route` stores and `localise` reads.
namespace place {

/// A place on a traverse.
struct Keyframe {
  std::int64_t frame = 0;   ///< index in the source video
  double time_s = 0;        ///< since its first frame
  double displacement = 0;  ///< travelled since the first frame, in the displacement's unit; 0 without motion
  std::optional<double> distance_m;        ///< travelled along the route, where surveyed
  std::optional<vo::Pose2> pose;           ///< where surveyed
  bool after_gap = false;                  ///< the recording was interrupted before it (`vo::parts_walk`)
  std::vector<std::uint8_t> preview_jpeg;  ///< a small picture for people; empty if none was kept
};

/// A place on a traverse that has a name: a shop, a crossing.
struct NamedPlace {
  std::string name;                  ///< UTF-8, never empty
  std::int64_t frame = 0;            ///< of the traverse's source video
  std::optional<double> distance_m;  ///< along the route, where surveyed
};

/// One walk along a route.
struct Traverse {
  std::string name;         ///< unique in its route
  std::string source;       ///< the recording it was built from, without folders
  std::int64_t frames = 0;  ///< of the source
  double duration_s = 0;    ///< from the first to the last frame
  int frame_width_px = 0;
  int frame_height_px = 0;
  std::string pose_source;  ///< file the poses came from, without folders; empty if none
  bool surveyed = true;     ///< false: the poses are the walk's own odometry, relative to its start
  std::vector<Keyframe> keyframes;
  std::vector<NamedPlace> places;        ///< in the order of their frames
  std::vector<Descriptors> descriptors;  ///< for each of the route's descriptors, one per keyframe
  /// One for each keyframe, if previews are kept; empty otherwise, or where they are the descriptors.
  vo::ImageStack thumbnails;
  /// SURF points of each keyframe (`vo::pack_view_points`); empty if they were not kept, or not read.
  std::vector<Bytes> view_points;
  Settings settings;  ///< resolved settings that shaped it
};

/// The place on the earth of a route's (0, 0): x points east, y north.
struct GeographicOrigin {
  double latitude_deg = 0;   ///< WGS 84
  double longitude_deg = 0;  ///< WGS 84
};

/// A reference route: any number of traverses, by day or by night.
struct Route {
  Settings settings;  ///< that walks on it adopt (`kept_by_route`)
  double unit = 0;  ///< between keyframes, in the displacement's unit (SSS Eq. 4's u, of the first traverse);
                    ///< 0 without motion
  bool metric = false;  ///< displacement is in metres; otherwise in frames at the first traverse's mean speed
  std::vector<Bytes> learned;  ///< by each descriptor from the first traverse (`Descriptor::learn`)
  std::vector<Traverse> traverses;
  std::optional<GeographicOrigin> origin;  ///< if the surveyed poses are geographic
  std::string software_version;            ///< of the program that wrote it
  std::optional<std::int64_t> digest;      ///< of the database that it was read from; none: made in memory
};

/// The thumbnails of a traverse's keyframes, wherever they are stored; null if it has none.
const vo::ImageStack* thumbnails_of(const Traverse& traverse);

/// The keyframes of a traverse before which its recording was interrupted: no sequence crosses one.
std::vector<std::size_t> gaps_of(const Traverse& traverse);

/// The distance walked between the first and the last of a traverse's surveyed keyframes; none if fewer than
/// two are surveyed. A track may begin late or end early.
std::optional<double> surveyed_m(const Traverse& traverse);

/// True if any traverse has SURF points to check a query against.
bool has_view_points(const Route& route);

/// True if any place of any traverse has a name.
bool has_named_places(const Route& route);

/// True if any keyframe has a pose to place a query with.
bool has_poses(const Route& route);

}  // namespace place
