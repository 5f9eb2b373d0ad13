#include "place/match/nearest_place.hpp"

#include "place/route/named_places.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace place {
namespace {

/// A named place on a traverse.
struct Landmark {
  const std::string* name = nullptr;
  double keyframe = 0;
  std::optional<double> distance_m;
};

std::optional<double> surveyed_at(const Traverse& traverse, double keyframe) {
  const auto low = static_cast<std::size_t>(keyframe);
  const std::optional<double>& a = traverse.keyframes[low].distance_m;
  const double t = keyframe - static_cast<double>(low);
  if (t == 0 || !a) return a;
  const std::optional<double>& b = traverse.keyframes[low + 1].distance_m;
  return b ? std::optional(std::lerp(*a, *b, t)) : std::nullopt;
}

std::vector<Landmark> landmarks_on(const Route& route, std::size_t traverse) {
  std::vector<Landmark> landmarks;
  for (const PlaceOnTraverse& one : places_on(route, traverse)) {
    landmarks.push_back({&route.traverses[one.traverse].places[one.index].name, one.keyframe,
                         surveyed_at(route.traverses[traverse], one.keyframe)});
  }
  return landmarks;
}

/// Metres, or else keyframes, to a landmark.
double from(const Place& at, const Landmark& landmark, bool in_metres) {
  return in_metres ? *landmark.distance_m - *at.distance_m
                   : landmark.keyframe - static_cast<double>(at.keyframe);
}

}  // namespace

void name_places(std::span<Match> matches, const Route& route) {
  if (!has_named_places(route)) return;
  std::vector<std::vector<Landmark>> landmarks;
  for (std::size_t t = 0; t < route.traverses.size(); ++t) landmarks.push_back(landmarks_on(route, t));
  for (Match& match : matches) {
    match.nearest_place.clear();
    match.nearest_place_m.reset();
    if (!match.place) continue;
    const Place& at = *match.place;
    const auto traverse = std::ranges::find(route.traverses, at.traverse, &Traverse::name);
    if (traverse == route.traverses.end() || at.keyframe >= traverse->keyframes.size())
      throw std::invalid_argument("name_places: matches on keyframes of the route expected");
    const std::vector<Landmark>& there =
        landmarks[static_cast<std::size_t>(traverse - route.traverses.begin())];
    const bool in_metres = at.distance_m && std::ranges::all_of(there, [](const Landmark& one) {
                             return one.distance_m.has_value();
                           });
    const auto nearest = std::ranges::min_element(
        there, {}, [&](const Landmark& one) { return std::abs(from(at, one, in_metres)); });
    if (nearest == there.end()) continue;
    match.nearest_place = *nearest->name;
    if (at.distance_m && nearest->distance_m) match.nearest_place_m = from(at, *nearest, true);
  }
}

}  // namespace place
