#include "route/keyframe_check.hpp"

#include <cmath>

namespace place {
namespace {

bool all_numbers(const Keyframe& k) {
  const bool posed = !k.pose || (std::isfinite(k.pose->x_m) && std::isfinite(k.pose->y_m) &&
                                 std::isfinite(k.pose->heading_rad));
  return posed && std::isfinite(k.time_s) && std::isfinite(k.displacement) &&
         std::isfinite(k.distance_m.value_or(0));
}

}  // namespace

std::string_view problem_of(std::span<const Keyframe> keyframes) {
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const Keyframe& k = keyframes[i];
    if (!all_numbers(k)) return "a value of a keyframe is no number";
    const bool in_order = i == 0 ? k.frame >= 0 && !k.after_gap
                                 : k.frame > keyframes[i - 1].frame && k.time_s >= keyframes[i - 1].time_s;
    if (!in_order) return "keyframes are not in order";
  }
  return {};
}

}  // namespace place
