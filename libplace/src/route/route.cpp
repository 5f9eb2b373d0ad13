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

bool has_poses(const Route& route) {
  return std::ranges::any_of(route.traverses, [](const Traverse& traverse) {
    return std::ranges::any_of(traverse.keyframes,
                               [](const Keyframe& keyframe) { return keyframe.pose.has_value(); });
  });
}

}  // namespace place
