#include "place/match/reference_timeline.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace place {
namespace {

constexpr std::size_t kFurthest = 5;  // keyframes of the route in one of the query; walks match one to one

std::size_t traverse_of(const Route& route, const Place& place) {
  const auto found = std::ranges::find(route.traverses, place.traverse, &Traverse::name);
  if (found == route.traverses.end() || place.keyframe >= found->keyframes.size())
    throw std::invalid_argument("reference_timeline: a match is not on the route");
  return static_cast<std::size_t>(found - route.traverses.begin());
}

std::optional<double> distance_m(const Route& route, const Keyframe& keyframe) {
  if (keyframe.distance_m) return keyframe.distance_m;
  return route.metric ? std::optional(keyframe.displacement) : std::nullopt;
}

/// The place on a traverse at a keyframe's fractional index.
ReferenceMoment at(const Route& route, std::size_t traverse, double keyframe) {
  const std::vector<Keyframe>& keyframes = route.traverses[traverse].keyframes;
  const auto before = static_cast<std::size_t>(keyframe);
  const std::size_t after = std::min(before + 1, keyframes.size() - 1);
  const double share = keyframe - static_cast<double>(before);
  ReferenceMoment moment{.traverse = traverse,
                         .keyframe = keyframe,
                         .frame = std::lerp(static_cast<double>(keyframes[before].frame),
                                            static_cast<double>(keyframes[after].frame), share),
                         .distance_m = distance_m(route, keyframes[before]),
                         .yaw_rad = {}};
  const std::optional<double> next = distance_m(route, keyframes[after]);
  if (moment.distance_m && next) moment.distance_m = std::lerp(*moment.distance_m, *next, share);
  return moment;
}

/// Whether the places between two matches in succession are known.
bool linked(const Route& route, const Match& a, const Match& b) {
  if (!a.accepted || !b.accepted || a.place->traverse != b.place->traverse) return false;
  const std::size_t from = a.place->keyframe, to = b.place->keyframe;
  if (to < from || to - from > kFurthest) return false;
  const std::vector<Keyframe>& keyframes = route.traverses[traverse_of(route, *a.place)].keyframes;
  for (std::size_t k = from + 1; k <= to; ++k) {
    if (keyframes[k].after_gap) return false;
  }
  return true;
}

void check(const Route& route, std::span<const Match> matches, std::size_t frames,
           std::span<const double> travelled) {
  if (!travelled.empty() && travelled.size() != frames)
    throw std::invalid_argument("reference_timeline: a displacement for each frame expected");
  std::int64_t last = -1;
  for (const Match& match : matches) {
    if (match.query_frame <= last || static_cast<std::size_t>(match.query_frame) >= frames)
      throw std::invalid_argument("reference_timeline: matches in order, within the walk, expected");
    last = match.query_frame;
    if (match.accepted && !match.place)
      throw std::invalid_argument("reference_timeline: an accepted match without a place");
    if (match.place) traverse_of(route, *match.place);
  }
}

}  // namespace

std::vector<QueryMoment> reference_timeline(const Route& route, std::span<const Match> matches,
                                            std::size_t frames, std::span<const double> travelled,
                                            std::span<const std::size_t> gaps) {
  check(route, matches, frames, travelled);
  if (matches.empty()) return {};
  const auto travelled_share = [&](std::size_t frame, std::size_t from, std::size_t to) {
    const bool moved = !travelled.empty() && travelled[to] > travelled[from];
    return moved ? (travelled[frame] - travelled[from]) / (travelled[to] - travelled[from])
                 : static_cast<double>(frame - from) / static_cast<double>(to - from);
  };

  std::vector<QueryMoment> timeline(frames);
  std::size_t next = 0;       // the first match after the frame
  bool interpolated = false;  // between the match before it and that one
  for (std::size_t frame = 0; frame < frames; ++frame) {
    while (next < matches.size() && static_cast<std::size_t>(matches[next].query_frame) <= frame) {
      ++next;
      interpolated = next < matches.size() && std::ranges::find(gaps, next) == gaps.end() &&
                     linked(route, matches[next - 1], matches[next]);
    }
    QueryMoment& moment = timeline[frame];
    const std::size_t before = next == 0 ? 0 : next - 1, after = std::min(next, matches.size() - 1);
    const auto from = static_cast<std::size_t>(matches[before].query_frame);
    const auto to = static_cast<std::size_t>(matches[after].query_frame);
    moment.match = before == after || frame - from < to - frame ? before : after;
    const Match& nearest = matches[moment.match];
    if (!nearest.accepted) continue;
    const std::size_t traverse = traverse_of(route, *nearest.place);
    if (!interpolated) {
      moment.reference = at(route, traverse, static_cast<double>(nearest.place->keyframe));
      moment.reference->yaw_rad = nearest.yaw_rad;
      continue;
    }
    const Match &a = matches[before], &b = matches[after];
    const double share = travelled_share(frame, from, to);
    moment.reference =
        at(route, traverse,
           std::lerp(static_cast<double>(a.place->keyframe), static_cast<double>(b.place->keyframe), share));
    moment.reference->yaw_rad =
        a.yaw_rad && b.yaw_rad ? std::lerp(*a.yaw_rad, *b.yaw_rad, share) : nearest.yaw_rad;
  }
  return timeline;
}

}  // namespace place
