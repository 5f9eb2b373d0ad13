#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <vo/base/pose2.hpp>

namespace place {

/// A place on a reference route.
struct Place {
  std::string traverse;              ///< name of the traverse matched against
  std::size_t keyframe = 0;          ///< index in it
  std::int64_t frame = 0;            ///< of the traverse's source video
  double time_s = 0;                 ///< since its first frame
  std::optional<double> distance_m;  ///< along the route, where surveyed
  std::optional<vo::Pose2> pose;     ///< where surveyed
};

/// Where a query keyframe was found.
struct Match {
  std::int64_t query_frame = 0;  ///< of the query's source video
  double query_time_s = 0;       ///< since its first frame
  std::optional<Place> place;    ///< none: nothing to match with (see `SequenceMatch::reference`)
  double score = 0;              ///< higher is surer; 0 without a place
  /// That the place is right; none if there was too little to learn it from, or no place.
  std::optional<double> probability;
  std::optional<double> sd_keyframes;  ///< standard deviation of the place, in keyframes of the traverse
  std::optional<double> sd_m;          ///< the same in metres along the route, where surveyed
  /// How far the camera is turned to the right of the reference's; none if the points do not say.
  std::optional<double> yaw_rad;
  std::optional<double> lateral_m;        ///< right of the reference's path; none as above, or without metres
  std::optional<double> ahead_m;          ///< of the matched keyframe, along its heading; none as above
  std::string nearest_place;              ///< of the route's named places (`name_places`); empty: none
  std::optional<double> nearest_place_m;  ///< along the route to it, negative if it is behind
  bool accepted = false;                  ///< meets the acceptance settings
  bool partial = false;                   ///< found on only a part of its line, at an end of either walk
};

}  // namespace place
