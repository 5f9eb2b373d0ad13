#include "place/route/route.hpp"

#include <algorithm>
#include <variant>

namespace place {

const vo::ImageStack* thumbnails_of(const Traverse& traverse) {
  if (!traverse.thumbnails.empty()) return &traverse.thumbnails;
  for (const Descriptors& descriptors : traverse.descriptors)
    if (const auto* images = std::get_if<vo::ImageStack>(&descriptors)) return images;
  return nullptr;
}

std::vector<std::size_t> gaps_of(const Traverse& traverse) {
  std::vector<std::size_t> gaps;
  for (std::size_t k = 0; k < traverse.keyframes.size(); ++k)
    if (traverse.keyframes[k].after_gap) gaps.push_back(k);
  return gaps;
}

std::optional<double> surveyed_m(const Traverse& traverse) {
  std::optional<double> first, length_m;
  for (const Keyframe& keyframe : traverse.keyframes) {
    if (!keyframe.distance_m) continue;
    if (first) length_m = *keyframe.distance_m - *first;
    if (!first) first = keyframe.distance_m;
  }
  return length_m;
}

bool has_view_points(const Route& route) {
  return std::ranges::any_of(route.traverses,
                             [](const Traverse& traverse) { return !traverse.view_points.empty(); });
}

bool has_named_places(const Route& route) {
  return std::ranges::any_of(route.traverses,
                             [](const Traverse& traverse) { return !traverse.places.empty(); });
}

bool has_poses(const Route& route) {
  return std::ranges::any_of(route.traverses, [](const Traverse& traverse) {
    return std::ranges::any_of(traverse.keyframes,
                               [](const Keyframe& keyframe) { return keyframe.pose.has_value(); });
  });
}

}  // namespace place
