#include "options.hpp"

#include "route.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace simulate {
namespace {

void check(std::string_view field, double value, double low, double high, std::string_view unit) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  throw vo::Error(field, fmt::format("is {:g}", value),
                  fmt::format("a number from {:g} to {:g}{}{}", low, high, unit.empty() ? "" : " ", unit));
}

}  // namespace

void validate(const Options& options) {
  // Sideways room: the pavement of the street is 4 m wide, the corridor 2.4 m, and a walker wanders by 0.25
  // m.
  const double room_m = options.scene == Scene::kStreet ? 1.5 : 0.6;
  check("length-m", options.length_m, 5, 5000, "m");
  check("lateral-m", options.lateral_m, -room_m, room_m, "m");
  check("camera-yaw-deg", options.camera_yaw_deg, -90, 90, "degrees");
  check("camera-pitch-deg", options.camera_pitch_deg, -45, 45, "degrees");
  check("people", options.people, 0, 1000, "");
  check("detour-m", options.detour_m, 0, kMaxDetour_m, "m");
  check("start-m", options.start_m, 0, options.length_m - 1, "m");
  check("failures", options.failures, 0, 100, "");
  check("failure-s", options.failure_s, 0.04, 60, "s");
  check("swing", options.swing, 0, 3, "");
  check("size", options.size.width, 16, 7680, "px wide");
  check("size", options.size.height, 16, 4320, "px high");
  check("frame-rate-hz", options.frame_rate_hz, 1, 240, "Hz");
  check("fov-deg", options.fov_deg, 10, 150, "degrees");
}

}  // namespace simulate
