#include "place/resolve.hpp"

#include "place/describe/descriptor_options.hpp"
#include "place/route/route.hpp"

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

// Metres between keyframes of metric motion: lines of ten find most from 0.8 to 0.9 m on (tests/RESULTS.md).
constexpr double kUsualSpacing_m = 0.85;
constexpr double kUsualN = 6;                 // of SSS Eq. 4
constexpr double kAcceptOriginalScore = 0.1;  // 1 - best / second best, another scale than ours

bool is(const std::optional<std::string>& value, std::string_view what) {
  return value && *value == what;
}

/// A copy with the settings that a walk takes from its route.
Settings with_route(Settings settings, const Settings& route) {
  const bool density_given = settings.sampling_n || settings.spacing_m;
  if (is(settings.motion, "auto") && route.motion) settings.motion = route.motion;
  for (const Setting& setting : settings_table()) {
    if (setting.of_route == OfRoute::kNo) continue;
    const std::optional<std::string> mine = text_of(settings, setting), routes = text_of(route, setting);
    if (setting.of_route == OfRoute::kFixed && mine && routes && mine != routes) {
      throw vo::Error(std::string(setting.name),
                      fmt::format("is {} and the route was built with {}", *mine, *routes),
                      "the same, or leave it out");
    }
    const bool density = setting.name == "sampling-n" || setting.name == "spacing-m";
    if (!mine && routes && !(density && density_given)) set(settings, setting, *routes);
  }
  if (settings.motion != route.motion && !is(settings.motion, "none")) {
    throw vo::Error("motion",
                    fmt::format("is {} and the route was sampled by {}, which has another unit",
                                *settings.motion, route.motion.value_or("none")),
                    "the same, or leave it out");
  }
  return settings;
}

/// False for settings that a purpose ignores.
bool serves(Purpose purpose, const Setting& setting) {
  if (purpose == Purpose::kLocalise) return true;
  if (purpose == Purpose::kOdometry) {
    for (const std::string_view of_keyframes :
         {"view-points", "every", "spacing-m", "sampling-n", "tie-scale"})
      if (setting.name == of_keyframes) return false;
  }
  if (purpose == Purpose::kOdometry && setting.group == SettingGroup::kDescribing) return false;
  return setting.group != SettingGroup::kSearch;
}

/// Whether SURF points of the keyframes are kept: of a walk to be localised if its matches are verified.
bool keeps_points(const Settings& settings, Purpose purpose) {
  return purpose == Purpose::kLocalise ? settings.verify.value_or(0) > 0
                                       : settings.view_points.value_or(false);
}

/// `has_effect`; for settings of odometry, also whether steps are tracked.
bool matters(const Settings& settings, const Setting& setting, const ResolveContext& context,
             std::string* why_not) {
  if (!has_effect(settings, setting, why_not)) return false;
  if (setting.group != SettingGroup::kOdometry || follows_steps(settings, context)) return true;
  if (setting.name == "camera-height-m") return true;  // of a trajectory from a file
  // Visual odometry and the points of keyframes are seen by the same camera.
  const bool sees = is(settings.motion, "vo") || is(settings.motion, "vo-sad");
  const bool of_camera = setting.name == "fov-deg" || setting.name == "camera";
  if (of_camera && (sees || keeps_points(settings, context.purpose))) return true;
  *why_not = fmt::format("motion is {}, so no steps are followed", settings.motion.value_or("none"));
  return false;
}

/// Odometry uses steps, with or without visual odometry.
void choose_odometry(Settings& settings) {
  if (!settings.motion || is(settings.motion, "auto")) settings.motion = "hybrid";
  if (!is(settings.motion, "hybrid") && !is(settings.motion, "steps"))
    throw vo::Error("motion", fmt::format("is {}", *settings.motion), "hybrid or steps for odometry");
}

/// The default density of keyframes.
void choose_density(Settings& settings, const Settings& given) {
  if (is(settings.motion, "none")) return;
  const bool surely_metric = is(settings.motion, "steps");
  const bool metric_file = is(settings.motion, "file") && !is(given.motion_file_unit, "none");
  const bool may_be_metric =
      surely_metric || is(settings.motion, "hybrid") || is(settings.motion, "auto") || metric_file;
  const bool only_spacing = given.spacing_m && !given.sampling_n;
  if (may_be_metric && !settings.spacing_m && !settings.sampling_n) settings.spacing_m = kUsualSpacing_m;
  if (!surely_metric && !only_spacing && !settings.sampling_n) settings.sampling_n = kUsualN;
}

void check_together(const Settings& settings) {
  if (is(settings.motion, "file") && !settings.motion_file)
    throw vo::Error("motion-file", "is missing", "a trajectory file, with motion file");
  if (is(settings.score, "ratio") && settings.min_fraction != 1)
    throw vo::Error("score", "is ratio, which part of a line has none of", "min-fraction 1");
  if (settings.v_min.has_value() != settings.v_max.has_value())
    throw vo::Error(settings.v_min ? "v-max" : "v-min", "is missing", "both v-min and v-max, or neither");
  if (settings.v_min && *settings.v_min > *settings.v_max)
    throw vo::Error("v-min", fmt::format("is {} and v-max {}", *settings.v_min, *settings.v_max),
                    "v-min <= v-max");
  const bool original = settings.compat && !is(settings.compat, "none");
  if (settings.patch_px && (original || !is(settings.patch_shape, "window"))) {
    for (const auto& side : {settings.thumbnail_width, settings.thumbnail_height})
      if (side && *side % *settings.patch_px != 0)
        throw vo::Error(
            "patch-px", fmt::format("is {} and a side of the thumbnail {}", *settings.patch_px, *side),
            original ? "a divisor of both sides" : "a divisor of both sides, or patch-shape window");
  }
  if (settings.max_shift_px && has_part(settings.descriptor, "thumbnail") &&
      2 * *settings.max_shift_px >= kShiftWidth_px) {
    throw vo::Error(
        "max-shift-px", fmt::format("is {}", *settings.max_shift_px),
        fmt::format("less than {}, half of a picture's width in these pixels", kShiftWidth_px / 2));
  }
}

}  // namespace

ResolveContext on_route(const Route& route, Purpose purpose) {
  return {.purpose = purpose,
          .route = &route.settings,
          .route_has_poses = has_poses(route),
          .route_has_points = has_view_points(route)};
}

bool follows_steps(const Settings& settings, const ResolveContext& context) {
  if (context.purpose == Purpose::kOdometry) return true;
  for (const char* const by_steps : {"steps", "hybrid", "auto"})
    if (is(settings.motion, by_steps)) return true;
  return context.purpose == Purpose::kLocalise && context.route_has_poses &&
         settings.correct_drift.value_or(true);
}

Settings resolve(const Settings& given, const ResolveContext& context) {
  check_ranges(given);
  const Settings own = context.route != nullptr ? with_route(given, *context.route) : given;
  Settings settings = own;
  if (context.purpose == Purpose::kOdometry) choose_odometry(settings);
  // The table is ordered so that a condition only depends on earlier settings.
  for (const Setting& setting : settings_table()) {
    if (!serves(context.purpose, setting)) {
      reset(settings, setting);
      continue;
    }
    std::string why_not;
    if (!matters(settings, setting, context, &why_not)) {
      if (text_of(given, setting) && !context.drop_ineffective)
        throw vo::Error(std::string(setting.name), fmt::format("has no effect: {}", why_not),
                        "another value there, or this setting left out");
      reset(settings, setting);
    } else if (!text_of(settings, setting) && !setting.standard.empty()) {
      set(settings, setting, setting.standard);
    }
    if (setting.name == "motion") choose_density(settings, own);
  }
  const bool by_score = settings.compat && !is(settings.compat, "none");
  if (by_score && !settings.accept_score) settings.accept_score = kAcceptOriginalScore;
  check_together(settings);
  if (settings.verify.value_or(0) > 0 && !context.route_has_points) {
    throw vo::Error("verify",
                    fmt::format("is {} and the route keeps no points of its keyframes", *settings.verify),
                    "0, or a route built with `retrace build --view-points true`");
  }
  return settings;
}

Settings kept_by_route(const Settings& given, const Settings& resolved) {
  Settings kept = merged(resolved, given);
  for (const Setting& setting : settings_table()) {
    if (setting.of_route == OfRoute::kNo) reset(kept, setting);
  }
  return kept;
}

}  // namespace place
