#include "added_traverse.hpp"

#include "json_file.hpp"

#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace retrace {

void print_added(const std::string& path, const place::Route& route, const place::AddedTraverse& added,
                 bool as_json) {
  const place::Traverse& traverse = route.traverses[added.index];
  if (as_json) {
    nlohmann::ordered_json json{{"route", path},
                                {"traverse", traverse.name},
                                {"frames", traverse.frames},
                                {"duration_s", traverse.duration_s},
                                {"keyframes", traverse.keyframes.size()},
                                {"traverses", route.traverses.size()},
                                {"sampling_unit", route.unit},
                                {"relative_scale", added.scale},
                                {"motion", *route.settings.motion},
                                {"gait_share", nullptr},
                                {"places", traverse.places.size()}};
    if (added.gait_share) json["gait_share"] = *added.gait_share;
    fmt::print("{}\n", json_text(json, 2));
    return;
  }
  fmt::print("{}: traverse '{}': {} frames, {:.1f} s, {} keyframes", path, traverse.name, traverse.frames,
             traverse.duration_s, traverse.keyframes.size());
  if (const std::optional<double> length_m = place::surveyed_m(traverse))
    fmt::print(", {:.1f} m surveyed", *length_m);
  fmt::print("; {} traverse{} in all\n", route.traverses.size(), route.traverses.size() == 1 ? "" : "s");
  if (added.gait_share)
    fmt::print("motion: {}, as {:.0f} % of the walk's motion is gait\n",
               route.settings.motion == "steps" ? "steps" : "sad (alignment error)", 100 * *added.gait_share);
}

}  // namespace retrace
