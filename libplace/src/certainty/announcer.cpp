#include "place/certainty/announcer.hpp"

#include "place/route/named_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <vo/base/trajectory.hpp>

namespace place {
namespace {

constexpr double kTurnAhead_m = 8, kEndAhead_m = 3, kPassing_m = 2, kPassingKeyframes = 1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kAway = 8;  // metres or keyframes from a named place, after which it can be passed again

/// Metres walked up to each keyframe, by the poses; empty unless all have one.
std::vector<double> along_poses_m(const Traverse& traverse) {
  std::vector<double> along;
  for (std::size_t k = 0; k < traverse.keyframes.size(); ++k) {
    const std::optional<vo::Pose2>& pose = traverse.keyframes[k].pose;
    if (!pose) return {};
    if (k == 0) {
      along.push_back(0);
      continue;
    }
    const vo::Pose2& before = *traverse.keyframes[k - 1].pose;
    along.push_back(along.back() + std::hypot(pose->x_m - before.x_m, pose->y_m - before.y_m));
  }
  return along;
}

/// The same by the survey; empty unless all have a distance.
std::vector<double> along_survey_m(const Traverse& traverse) {
  std::vector<double> along;
  for (const Keyframe& keyframe : traverse.keyframes) {
    if (!keyframe.distance_m) return {};
    along.push_back(*keyframe.distance_m);
  }
  return along;
}

/// The keyframe at a distance along, held to the ends.
std::size_t keyframe_at(const std::vector<double>& along_m, double at_m) {
  const auto after = std::ranges::lower_bound(along_m, at_m);
  return std::min(along_m.size() - 1, static_cast<std::size_t>(after - along_m.begin()));
}

}  // namespace

std::string name_of(FollowEventKind kind) {
  switch (kind) {
    case FollowEventKind::kFound:
      return "found";
    case FollowEventKind::kLeftRoute:
      return "left_route";
    case FollowEventKind::kBackOnRoute:
      return "back_on_route";
    case FollowEventKind::kTurnAhead:
      return "turn_ahead";
    case FollowEventKind::kPassing:
      return "passing";
    case FollowEventKind::kEndOfRoute:
      return "end_of_route";
  }
  return "";
}

std::vector<RouteTurn> turns_of(const Traverse& traverse) {
  constexpr double kReach_m = 2, kLeast_deg = 30;
  const std::vector<double> along = along_poses_m(traverse);
  std::vector<RouteTurn> turns;
  bool turning = false;
  for (std::size_t k = 0; k < along.size(); ++k) {
    const auto heading = [&](double at_m) {
      return traverse.keyframes[keyframe_at(along, at_m)].pose->heading_rad;
    };
    const double turn_deg = vo::wrap_angle_rad(heading(along[k] + kReach_m) - heading(along[k] - kReach_m)) *
                            180 / std::numbers::pi;
    if (std::abs(turn_deg) < kLeast_deg) {
      turning = false;
    } else if (!turning) {
      turns.push_back({along[k], turn_deg});
      turning = true;
    } else if (std::abs(turn_deg) > std::abs(turns.back().turn_deg)) {
      turns.back() = {along[k], turn_deg};
    }
  }
  return turns;
}

Announcer::Announcer(const Route& route) {
  std::vector<std::size_t> first;  // number of each traverse's first named place
  for (const Traverse& traverse : route.traverses) {
    first.push_back(names_.size());
    for (const NamedPlace& named : traverse.places) names_.push_back(named.name);
  }
  passed_.resize(names_.size(), false);
  for (std::size_t t = 0; t < route.traverses.size(); ++t) {
    const Traverse& traverse = route.traverses[t];
    Course course{traverse.name, along_poses_m(traverse), turns_of(traverse), {}};
    if (course.along_m.empty()) course.along_m = along_survey_m(traverse);
    for (const PlaceOnTraverse& place : places_on(route, t)) {
      const auto below = static_cast<std::size_t>(place.keyframe);
      double at = place.keyframe;
      if (!course.along_m.empty()) {
        const std::size_t above = std::min(below + 1, course.along_m.size() - 1);
        at = std::lerp(course.along_m[below], course.along_m[above],
                       place.keyframe - static_cast<double>(below));
      }
      course.landmarks.push_back({first[place.traverse] + place.index, at});
    }
    courses_.push_back(std::move(course));
  }
}

void Announcer::pass(std::size_t index, const Position& position, std::vector<FollowEvent>& events) {
  const Course& course = courses_[index];
  const bool metric = !course.along_m.empty();
  const std::size_t keyframe = position.place->keyframe;
  const double at = metric ? course.along_m[keyframe] : static_cast<double>(keyframe);
  const double near = metric ? kPassing_m : kPassingKeyframes;
  // Between two lines he may have come past it; if he came further, he was somewhere else before.
  const double from = course_ == index && at > at_ && at - at_ <= kAway ? at_ : at;
  for (const Landmark& landmark : course.landmarks) {
    const double ahead = landmark.at - at;
    const bool passing = std::abs(ahead) <= near || (landmark.at > from && landmark.at < at);
    if (std::abs(ahead) > kAway) passed_[landmark.number] = false;
    if (!passing || passed_[landmark.number]) continue;
    // Another traverse may have its own place of this name: it is the same one, wherever he is placed next.
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const bool here = std::ranges::find(course.landmarks, i, &Landmark::number) != course.landmarks.end();
      if (i == landmark.number || (!here && names_[i] == names_[landmark.number])) passed_[i] = true;
    }
    events.push_back({.kind = FollowEventKind::kPassing,
                      .frame = position.frame,
                      .time_s = position.time_s,
                      .distance_m = metric ? std::optional(ahead) : std::nullopt,
                      .turn_deg = {},
                      .name = names_[landmark.number]});
  }
  course_ = index;
  at_ = at;
}

std::vector<FollowEvent> Announcer::push(const Position& position) {
  std::vector<FollowEvent> events;
  const auto say = [&](FollowEventKind kind, std::optional<double> distance_m = {},
                       std::optional<double> turn_deg = {}) {
    events.push_back({kind, position.frame, position.time_s, distance_m, turn_deg, {}});
  };
  if (position.state != state_) {
    if (position.state == FollowState::kOnRoute)
      say(left_ ? FollowEventKind::kBackOnRoute : FollowEventKind::kFound);
    if (position.state == FollowState::kOffRoute) {
      say(FollowEventKind::kLeftRoute);
      passed_.assign(passed_.size(), false);
    }
    if (position.state != FollowState::kSearching) left_ = position.state == FollowState::kOffRoute;
    announced_to_m_.reset();
    end_announced_ = false;
    course_.reset();
    state_ = position.state;
  }
  if (!position.place) return events;
  const auto course = std::ranges::find(courses_, position.place->traverse, &Course::traverse);
  if (course == courses_.end()) return events;
  const auto index = static_cast<std::size_t>(course - courses_.begin());
  const std::optional<std::size_t> course_before = course_;
  const double before = at_;
  pass(index, position, events);
  if (course->along_m.empty()) return events;
  const double at_m = course->along_m[position.place->keyframe];
  if (course_before && course_before != index) {  // announced as far ahead of him as before
    if (courses_[*course_before].along_m.empty()) announced_to_m_.reset();
    if (announced_to_m_) *announced_to_m_ += at_m - before;
  } else if (course_before && at_m < before - kAway) {
    announced_to_m_.reset();  // set back: another round
  }
  for (const RouteTurn& turn : course->turns) {
    if (turn.at_m <= at_m || turn.at_m > at_m + kTurnAhead_m ||
        turn.at_m <= announced_to_m_.value_or(-kInfinity))
      continue;
    say(FollowEventKind::kTurnAhead, turn.at_m - at_m, turn.turn_deg);
    announced_to_m_ = turn.at_m;
  }
  const double left_m = course->along_m.back() - at_m;
  if (left_m > kAway) end_announced_ = false;
  if (!end_announced_ && left_m <= kEndAhead_m) {
    say(FollowEventKind::kEndOfRoute, left_m);
    end_announced_ = true;
  }
  return events;
}

}  // namespace place
