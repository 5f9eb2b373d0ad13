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
  kPassing,  ///< a named place
  kEndOfRoute,
};

/// The kind as a word: "found", "left_route", "back_on_route", "turn_ahead", "passing",
/// "end_of_route".
std::string name_of(FollowEventKind kind);

struct FollowEvent {
  FollowEventKind kind = FollowEventKind::kFound;
  std::int64_t frame = 0;
  double time_s = 0;
  /// To a turn, a named place or the end of the route; negative if a named place is behind him.
  std::optional<double> distance_m;
  std::optional<double> turn_deg;  ///< of a turn, clockwise positive
  std::string name;                ///< of a named place, else empty
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
/// m, turns on traverses with poses. A named place (`places_on`) is announced once each time the walker
/// passes it: 2 m before it, or one keyframe on a traverse without metres; again only after he was 8 m (or
/// eight keyframes) away from it, or off the route.
class Announcer {
 public:
  /// Keeps nothing of the route.
  explicit Announcer(const Route& route);

  /// Positions in order, of a follower on the same route.
  std::vector<FollowEvent> push(const Position& position);

 private:
  /// A named place on a traverse.
  struct Landmark {
    std::size_t number = 0;  // among all named places
    double at = 0;           // metres along, or keyframes
  };
  /// A traverse: where its keyframes lie along it, its turns and named places.
  struct Course {
    std::string traverse;
    std::vector<double> along_m;  // by its poses or its survey; empty without either
    std::vector<RouteTurn> turns;
    std::vector<Landmark> landmarks;
  };

  void pass(std::size_t index, const Position& position, std::vector<FollowEvent>& events);

  std::vector<Course> courses_;
  std::vector<std::string> names_;     // of all named places
  std::vector<bool> passed_;           // by number: announced, and not left behind since
  std::optional<std::size_t> course_;  // of the position before, if it was on the route
  double at_ = 0;                      // where on it
  FollowState state_ = FollowState::kSearching;
  bool left_ = false;                     // the route, and was not back since
  std::optional<double> announced_to_m_;  // turns up to here were announced
  bool end_announced_ = false;
};

}  // namespace place
