#include "build_report.hpp"

#include "report/alignment_data.hpp"
#include "report/alignment_figures.hpp"
#include "report/page.hpp"
#include "report/run_charts.hpp"
#include "report/settings_table.hpp"
#include "settings_file.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/stage_options.hpp>

namespace retrace {
namespace {

WalkColumns traverse_columns(const place::Traverse& traverse) {
  WalkColumns columns{.name = traverse.name};
  for (const place::Keyframe& keyframe : traverse.keyframes) {
    columns.frame.push_back(static_cast<double>(keyframe.frame));
    columns.time_s.push_back(keyframe.time_s);
    columns.displacement.push_back(keyframe.displacement);
    columns.distance_m.push_back(keyframe.distance_m.value_or(NAN));
  }
  return columns;
}

std::string motion_in_words(const place::AddedTraverse& added) {
  if (!added.gait_share) return "as asked for, or as the route's";
  return fmt::format("{:.0f} % of the motion is gait", 100 * *added.gait_share);
}

}  // namespace

std::string build_report(const place::Route& route, const place::AddedTraverse& added, const vo::Walk& walk,
                         const place::Settings& settings) {
  const place::Traverse& traverse = route.traverses[added.index];
  Page page(fmt::format("Traverse '{}' of a route", traverse.name), walk.source);
  page.headlines({{"Frames", std::to_string(traverse.frames), fmt::format("{:.1f} s", traverse.duration_s)},
                  {"Keyframes", std::to_string(traverse.keyframes.size()), "kept of them"},
                  {"Motion", route.settings.motion.value_or("none"), motion_in_words(added)},
                  {"Relative scale", fmt::format("{:.3f}", added.scale), "of its motion to the route's"}});
  for (const std::string& warning : walk.warnings) page.warning(warning);
  for (const std::string& warning : added.warnings) page.warning(warning);
  const nlohmann::ordered_json nothing = nlohmann::ordered_json::object();
  const RunView view{.folder = {},
                     .matches = {},
                     .unit = route.unit,
                     .query = {},
                     .traverses = {traverse_columns(traverse)},
                     .counts = {},
                     .data = nothing,
                     .truth = nullptr,
                     .true_frame = {}};
  page.chart("Speed", speed_chart(view), "Displacement in a second, over a second about each moment.");
  page.chart("", keyframe_chart(view),
             "Displacement between neighbouring keyframes, in units of the sampling: constant, except where "
             "more than a unit is covered between two frames.");
  place::Settings used = settings;
  used.motion = route.settings.motion;  // what `auto` chose
  const place::StageOptions stages = place::stage_options(used, true);
  const nlohmann::ordered_json alignment = alignment_data(walk, {}, stages.sampling.motion.visual);
  if (alignment.empty())
    page.paragraph("The walk shows no motion that alignment error could be learned from.");
  put_alignment(page, alignment);
  put_settings(page, to_toml(used));
  return page.html();
}

}  // namespace retrace
