#pragma once

#include "place/certainty/follower.hpp"
#include "place/route/route.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace place {

/// Something that a walker who follows a route should be told.
enum class FollowEventKind {
  kFound,  ///< on the route for the first time, or again after he was lost
  kLeftRoute,
  kBackOnRoute,  ///< after he left it
  kTurnAhead,
  kEndOfRoute,
};

/// The kind as a word: "found", "left_route", "back_on_route", "turn_ahead", "end_of_route".
std::string name_of(FollowEventKind kind);

struct FollowEvent {
  FollowEventKind kind = FollowEventKind::kFound;
  std::int64_t frame = 0;
  double time_s = 0;
  std::optional<double> distance_m;  ///< to a turn, or to the end of the route
  std::optional<double> turn_deg;    ///< of a turn, clockwise positive
};

/// A turn of a traverse.
struct RouteTurn {
  double at_m = 0;      ///< along its poses
  double turn_deg = 0;  ///< clockwise positive
};

/// The turns of a traverse: where the heading over 2 m before and after differs by 30 degrees or more, at the
/// greatest difference. Without poses there are none. O(keyframes).
std::vector<RouteTurn> turns_of(const Traverse& traverse);

/// Makes events of positions. Turns and the end are announced once each time they come nearer than 8 m and 3
/// m, on traverses with poses.
class Announcer {
 public:
  /// Keeps nothing of the route.
  explicit Announcer(const Route& route);

  /// Positions in order, of a follower on the same route.
  std::vector<FollowEvent> push(const Position& position);

 private:
  /// A traverse: where its keyframes lie along its poses, and its turns.
  struct Course {
    std::string traverse;
    std::vector<double> along_m;
    std::vector<RouteTurn> turns;
  };

  std::vector<Course> courses_;
  FollowState state_ = FollowState::kSearching;
  bool left_ = false;                     // the route, and was not back since
  std::optional<double> announced_to_m_;  // turns up to here were announced
  bool end_announced_ = false;
};

}  // namespace place
