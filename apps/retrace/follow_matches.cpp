#include "follow_matches.hpp"

#include "follow_page.hpp"

#include <algorithm>
#include <optional>

namespace retrace {
namespace {

void put_match(place::Match& match, const std::optional<place::FollowedPlace>& at,
               const place::Route& route) {
  match = {.query_frame = match.query_frame, .query_time_s = match.query_time_s, .place = {}};
  if (!at) return;
  const place::Keyframe& keyframe = route.traverses[traverse_of(*at, route)].keyframes[at->keyframe];
  match.place = place::Place{.traverse = at->traverse,
                             .keyframe = at->keyframe,
                             .frame = at->reference_frame,
                             .time_s = keyframe.time_s,
                             .distance_m = at->distance_m,
                             .pose = at->pose};
  match.score = at->probability;
  match.probability = at->probability;
  match.sd_keyframes = at->sd_keyframes;
  match.sd_m = at->sd_m;
  match.accepted = true;
}

}  // namespace

void FollowMatches::revise(std::int64_t frame, const std::optional<place::FollowedPlace>& at) {
  const auto match = std::ranges::lower_bound(matches_, frame, {}, &place::Match::query_frame);
  if (match != matches_.end() && match->query_frame == frame) put_match(*match, at, route_);
}

void FollowMatches::push(const place::Position& position) {
  if (!position.described) return;
  matches_.push_back({.query_frame = position.frame, .query_time_s = position.time_s, .place = {}});
  put_match(matches_.back(), position.place, route_);
  if (position.lag_frame) revise(*position.lag_frame, position.lag_place);
}

void FollowMatches::finish(const std::vector<place::EarlierPlace>& earlier) {
  for (const place::EarlierPlace& one : earlier) revise(one.frame, one.place);
}

}  // namespace retrace
