#include "command.hpp"
#include "report/heat_picture.hpp"
#include "report/sweep_report.hpp"
#include "run_directory.hpp"
#include "settings.hpp"
#include "sweep_grid.hpp"
#include "sweep_run.hpp"
#include "truth_options.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::vector<Axis> axes_of(const SweepOptions& options) {
  std::vector<Axis> axes{{"motion", options.motions},
                         {"sequence-length", options.lengths},
                         {"search-range-rad", options.ranges}};
  for (const std::string& text : options.vary) {
    axes.push_back(parse_axis(text));
    const auto same = std::ranges::find(axes, axes.back().setting, &Axis::setting);
    if (same != axes.end() - 1)
      throw vo::Error("--vary " + text, "varies a setting twice",
                      fmt::format("one list of {}", same->setting));
  }
  return axes;
}

/// What a sweep is of; another one does not go into the same folder.
std::string description(const SweepOptions& options, const std::vector<Axis>& axes) {
  std::string text = fmt::format(
      "# Sweep of {} on {}\n# truth: {} {} {}, tolerance {} {}\n# varied:", options.query, options.reference,
      options.truth.pairs, options.truth.query_truth, options.truth.reference_truth,
      options.truth.tolerance_m.value_or(options.truth.tolerance_frames.value_or(0)),
      options.truth.tolerance_m ? "m" : "reference frames");
  for (const Axis& axis : axes) text += " " + axis.setting;
  Settings settings = options.settings;
  settings.threads = 0;  // makes no difference
  return text + "\n" + to_toml(settings);
}

/// What was done before, if the folder holds the same sweep. Throws if it holds another.
SweepResults resume(const fs::path& folder, const std::vector<Axis>& axes, const std::string& description,
                    bool force) {
  prepare_run_directory(folder, {}, true);
  const fs::path mark = folder / "sweep.toml";
  SweepResults done;
  if (!force) {
    std::ifstream file(mark);
    const std::string before{std::istreambuf_iterator<char>(file), {}};
    if (fs::exists(mark) ? before != description : fs::exists(folder / "sweep.csv")) {
      throw vo::Error(folder.string(), "holds another sweep", "another folder, or --force to begin anew");
    }
    done = read_sweep(folder / "sweep.csv", axes);
  }
  vo::write_file(folder / "sweep.csv", sweep_csv(axes, done));
  vo::write_file(mark, description);
  return done;
}

std::string flags_of(const std::vector<Axis>& axes, const Cell& cell) {
  std::string flags;
  for (std::size_t i = 0; i < axes.size(); ++i) flags += fmt::format(" --{} {}", axes[i].setting, cell[i]);
  return flags;
}

ordered_json cell_json(const std::vector<Axis>& axes, const Cell& cell,
                       const std::optional<CellResult>& result) {
  ordered_json json;
  for (std::size_t i = 0; i < axes.size(); ++i) json[axes[i].setting] = cell[i];
  if (!result) return json;
  json.update({{"query_keyframes", result->query_keyframes},
               {"reference_keyframes", result->reference_keyframes},
               {"max_f1", result->max_f1},
               {"precision", result->precision},
               {"recall", result->recall},
               {"auc_pr", result->auc_pr}});
  return json;
}

void print(const SweepOptions& options, const std::vector<Axis>& axes, const SweepResults& results) {
  const std::optional<Cell> best = best_cell(axes, results);
  if (options.common.json) {
    ordered_json json{{"best", nullptr}, {"cells", ordered_json::array()}};
    if (best) json["best"] = cell_json(axes, *best, results.at(*best));
    for (const Cell& cell : all_cells(axes)) json["cells"].push_back(cell_json(axes, cell, results.at(cell)));
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("  {:<8}{:>14}{:>8}{:>11}{:>9}   {}\n", "motion", "keyframes", "max-F1", "precision", "recall",
             "at");
  for (const std::string& motion : options.motions) {
    const std::optional<Cell> cell = best_cell(axes, results, motion);
    if (!cell) continue;
    const CellResult& r = *results.at(*cell);
    fmt::print("  {:<8}{:>14}{:>8.3f}{:>11.3f}{:>9.3f}  {}\n", motion,
               fmt::format("{} x {}", r.query_keyframes, r.reference_keyframes), r.max_f1, r.precision,
               r.recall, flags_of(axes, *cell));
  }
  if (best) fmt::print("best:{}\n", flags_of(axes, *best));
  fmt::print("{} cells; see {}\n", results.size(), (fs::path(options.output) / "report.html").string());
}

void sweep(const CLI::App& app, const SweepOptions& options) {
  vo::set_thread_count(options.settings.threads);
  const std::vector<Axis> axes = axes_of(options);
  for (const Cell& cell : all_cells(axes))
    settings_at(options.settings, axes, cell);  // are they all in range?
  const fs::path folder = options.output;
  SweepResults results = resume(folder, axes, description(options, axes), options.common.force);
  if (!run_sweep(options, axes, results, given(app, "--every"))) {
    throw vo::Error(options.output, "the sweep was stopped",
                    "the same command again, which goes on from here");
  }
  const std::string tolerance = options.truth.tolerance_m
                                    ? fmt::format("{:g} metres", *options.truth.tolerance_m)
                                    : fmt::format("{:g} reference frames", *options.truth.tolerance_frames);
  vo::write_file(folder / "report.html",
                 sweep_report(axes, results, fmt::format("{} on {}", options.query, options.reference),
                              {{"Cells", std::to_string(results.size())}, {"Right is within", tolerance}}));
  const std::vector<std::uint8_t> png = heat_picture(heat_tables(axes, results));
  vo::write_file(folder / "heat_map.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  print(options, axes, results);
}

/// Replaces a setting of one value by a list of them.
void add_list(CLI::App& app, const std::string& name, std::vector<std::string>& values,
              const std::string& description) {
  if (CLI::Option* single = app.get_option_no_throw(name)) app.remove_option(single);
  app.add_option(name, values, description)->delimiter(',')->capture_default_str()->group("Swept");
}

}  // namespace

Command add_sweep(CLI::App& root) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* app =
      root.add_subcommand("sweep", "which settings find a walk on another best, by precision and recall");
  app->add_option("query", options->query, "walk to be found: video file or folder of images")->required();
  app->add_option("--reference", options->reference, "walk to be found on")->required();
  app->add_option("-o,--output", options->output, "folder for the results; a sweep that was stopped goes on")
      ->required();
  add_truth_options(*app, options->truth);
  add_all_options(*app, options->settings);
  add_list(*app, "--motion", options->motions, "sad, steps, hybrid, vo, none: what walks are resampled by");
  add_list(*app, "--sequence-length", options->lengths, "keyframes on a line [SSS 4.2]");
  add_list(*app, "--search-range-rad", options->ranges, "radians either side of pi/4 [SSS Fig. 8]");
  app->add_option("--vary", options->vary,
                  "NAME=a,b,c: any further setting of sampling or search; may be repeated")
      ->group("Swept")
      ->take_all();
  for (const char* name : {"--compat", "--sequence-length-m"}) app->remove_option(app->get_option(name));
  add_config_option(*app, options->common);
  add_force_option(*app, options->common);
  add_json_option(*app, options->common);
  app->footer(
      "Both walks are read once; a cost matrix is computed once for all cells that share it. With --motion "
      "none and no\n"
      "--every, every so many frames are kept that there are as many keyframes as with the first other "
      "motion.\n"
      "Examples:\n"
      "  retrace sweep night.mp4 --reference day.mp4 --query-truth night.csv --reference-truth day.csv \\\n"
      "    --tolerance-m 4 -o sweep\n"
      "  retrace sweep night.mp4 --reference day.mp4 --pairs pairs.csv --tolerance-frames 17 -o sweep \\\n"
      "    --motion sad,steps,none --sequence-length 5,10,20,40,80 --vary enhance=local,standardise");
  return {app, [app, options] { sweep(*app, *options); }};
}

}  // namespace retrace
