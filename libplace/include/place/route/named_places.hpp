#pragma once

#include "place/route/route.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace place {

/// A row of a file of names: either a frame or a distance.
struct PlaceName {
  std::string name;
  std::optional<std::int64_t> frame;  ///< of the walk's video
  std::optional<double> distance_m;   ///< along the route, as surveyed
  std::string where;                  ///< file and line, for messages
};

/// Reads a CSV file with the columns `frame,name` or `distance_m,name`. Throws `vo::Error` naming file and
/// line if it cannot be read, has neither or both of the columns, has no row, or a name is empty, not UTF-8,
/// has control characters, or is longer than 200 bytes.
std::vector<PlaceName> read_place_names(const std::filesystem::path& path);

/// The names as places of a traverse, in the order of their frames. What a row does not give, the frame or
/// the distance, comes from the keyframes, interpolated. Throws `vo::Error` naming the row for a frame that
/// the walk does not have, a distance that it does not reach, or a distance on a walk without a survey.
std::vector<NamedPlace> named_places(const std::vector<PlaceName>& names, const Traverse& traverse);

/// A named place as seen from a traverse.
struct PlaceOnTraverse {
  std::size_t traverse = 0;  ///< whose place it is
  std::size_t index = 0;     ///< among that traverse's places
  double keyframe = 0;       ///< where it is on the traverse asked about, between its keyframes too
};

/// The named places of a route on one of its traverses: its own, and those of other traverses at its nearest
/// keyframe by poses, where that is within 3 m and it has none of the same name within 10 m. In order of the
/// traverses and their places. O(places * keyframes).
std::vector<PlaceOnTraverse> places_on(const Route& route, std::size_t traverse);

}  // namespace place
