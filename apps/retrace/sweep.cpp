#include "command.hpp"
#include "report/heat_picture.hpp"
#include "report/sweep_report.hpp"
#include "run_directory.hpp"
#include "settings_file.hpp"
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

#include <place/resolve.hpp>
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
  std::string text =
      fmt::format("# Sweep of {} on {}\n# truth: {} {} {}, tolerance {}\n# varied:", options.query,
                  options.reference, options.truth.pairs, options.truth.query_truth,
                  options.truth.reference_truth, tolerance_text(options.truth.tolerance));
  for (const Axis& axis : axes) text += " " + axis.setting;
  place::Settings settings = options.settings;
  settings.threads.reset();  // makes no difference
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

/// Every cell's settings must be in range and go together, and every setting have an effect in some cell.
void check_settings(const SweepOptions& options, const std::vector<Axis>& axes) {
  place::Settings with_effect;
  for (const Cell& cell : all_cells(axes))
    with_effect = place::merged(
        with_effect, place::resolve(settings_at(options.settings, axes, cell), {.pass_over = true}));
  for (const place::Setting& setting : place::settings_table()) {
    if (place::text_of(options.settings, setting) && !place::text_of(with_effect, setting))
      throw vo::Error(std::string(setting.name), "has no effect in any cell of this sweep",
                      "other axes, or this setting left out");
  }
}

void sweep(const SweepOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  const std::vector<Axis> axes = axes_of(options);
  check_settings(options, axes);
  const fs::path folder = options.output;
  SweepResults results = resume(folder, axes, description(options, axes), options.common.force);
  if (!run_sweep(options, axes, results)) {
    throw vo::Error(options.output, "the sweep was stopped",
                    "the same command again, which goes on from here");
  }
  vo::write_file(folder / "report.html",
                 sweep_report(axes, results, fmt::format("{} on {}", options.query, options.reference),
                              {{"Cells", std::to_string(results.size())},
                               {"Right is within", tolerance_text(options.truth.tolerance)}}));
  const std::vector<std::uint8_t> png = heat_picture(heat_tables(axes, results));
  vo::write_file(folder / "heat_map.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  print(options, axes, results);
}

}  // namespace

std::function<void()> declare_sweep(Arguments& arguments) {
  auto options = std::make_shared<SweepOptions>();
  arguments.positional("query", options->query, "walk to be found: video file or folder of images");
  arguments.option("--reference", options->reference, "walk to be found on").required();
  arguments.option("-o,--output", options->output, "folder for the results; a sweep that was stopped goes on")
      .required();
  declare_truth(arguments, options->truth);
  const auto list = [&](const char* flag, std::vector<std::string>& values, const char* description) {
    arguments.option(flag, values, description).comma_separated().group("Swept");
  };
  list("--motion", options->motions, "sad, steps, hybrid, vo, none: what walks are resampled by");
  list("--sequence-length", options->lengths, "keyframes on a line [SSS 4.2]");
  list("--search-range-rad", options->ranges, "radians either side of pi/4 [SSS Fig. 8]");
  arguments
      .option("--vary", options->vary,
              "NAME=a,b,c: any further setting of sampling or search; may be repeated")
      .group("Swept");
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kDescribing, kMotion, kOdometry, kSearch, kGeneral},
                     {"motion", "sequence-length", "search-range-rad", "compat", "sequence-length-m",
                      "motion-file", "motion-file-start-s", "motion-file-gap-s"});
  arguments.common(options->common);
  arguments.footer(
      "Both walks are read once; a cost matrix is computed once for all cells that share it. With --motion "
      "none and no\n"
      "--every, every so many frames are kept that there are as many keyframes as with the first other "
      "motion.\n"
      "Examples:\n"
      "  retrace sweep night.mp4 --reference day.mp4 --query-truth night.csv --reference-truth day.csv \\\n"
      "    --tolerance-m 4 -o sweep\n"
      "  retrace sweep night.mp4 --reference day.mp4 --pairs pairs.csv --tolerance-frames 17 -o sweep \\\n"
      "    --motion sad,steps,none --sequence-length 5,10,20,40,80 --vary enhance=local,standardise");
  return [options] { sweep(*options); };
}

}  // namespace retrace
