#include "sweep_files.hpp"

#include "methods_table.hpp"
#include "report/heat_picture.hpp"
#include "report/sweep_report.hpp"
#include "run_directory.hpp"
#include "settings_file.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The files of a walk.
std::string shown(const std::vector<std::string>& walk) {
  return fmt::format("{}", fmt::join(walk, ", "));
}

/// What identifies a sweep; a different one may not use the same folder.
std::string description_of(const SweepOptions& options, const std::vector<place::SweepAxis>& axes) {
  std::string text =
      fmt::format("# Sweep of {} on {}\n# truth: {} {} {}, tolerance {}\n# varied:", shown(options.query),
                  shown(options.reference), options.truth.pairs, options.truth.query_truth,
                  options.truth.reference_truth, tolerance_text(options.truth.tolerance));
  for (const place::SweepAxis& axis : axes) text += " " + axis.setting;
  place::Settings settings = options.settings;
  settings.threads.reset();  // does not affect results
  if (options.equal_keyframes) text += "\n# equal keyframes";
  return text + "\n" + to_toml(settings);
}

std::string flags_of(const std::vector<place::SweepAxis>& axes, const place::SweepCell& cell) {
  std::string flags;
  for (std::size_t i = 0; i < axes.size(); ++i) flags += fmt::format(" --{} {}", axes[i].setting, cell[i]);
  return flags;
}

ordered_json cell_json(const std::vector<place::SweepAxis>& axes, const place::SweepCell& cell,
                       const std::optional<place::CellResult>& result) {
  ordered_json json;
  for (std::size_t i = 0; i < axes.size(); ++i) json[axes[i].setting] = cell[i];
  if (!result) return json;
  json.update({{"query_keyframes", result->query_keyframes},
               {"reference_keyframes", result->reference_keyframes},
               {"density", result->density},
               {"max_f1", result->max_f1},
               {"precision", result->precision},
               {"recall", result->recall},
               {"auc_pr", result->auc_pr}});
  return json;
}

}  // namespace

place::SweepResults resume_sweep(const SweepOptions& options, const std::vector<place::SweepAxis>& axes) {
  const fs::path folder = options.output;
  const std::string description = description_of(options, axes);
  prepare_run_directory(folder, {}, true);
  const fs::path mark = folder / "sweep.toml";
  place::SweepResults done;
  if (!options.common.force) {
    std::ifstream file(mark);
    const std::string before{std::istreambuf_iterator<char>(file), {}};
    if (fs::exists(mark) ? before != description : fs::exists(folder / "sweep.csv")) {
      throw vo::Error(folder.string(), "holds another sweep", "another folder, or --force to begin anew");
    }
    done = place::read_sweep(folder / "sweep.csv", axes);
  }
  write_sweep_csv(options, axes, done);
  vo::write_file(mark, description);
  return done;
}

void write_sweep_csv(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const place::SweepResults& results) {
  vo::write_file(fs::path(options.output) / "sweep.csv", place::sweep_csv(axes, results));
}

void write_sweep_report(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                        const place::SweepResults& results,
                        const std::vector<place::ComparedMethod>& methods) {
  const fs::path folder = options.output;
  vo::write_file(folder / "methods.json", methods_json(axes, options.compare, methods).dump(2) + "\n");
  vo::write_file(
      folder / "report.html",
      sweep_report(axes, results, fmt::format("{} on {}", shown(options.query), shown(options.reference)),
                   {{"Cells", std::to_string(results.size())},
                    {"Right is within", tolerance_text(options.truth.tolerance)}},
                   methods_table(axes, options.compare, methods)));
  const std::vector<std::uint8_t> png = heat_picture(heat_tables(axes, results));
  vo::write_file(folder / "heat_map.png", {reinterpret_cast<const char*>(png.data()), png.size()});
}

void print_sweep(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                 const place::SweepResults& results, const std::vector<place::ComparedMethod>& methods) {
  const std::optional<place::SweepCell> best = best_cell(axes, results);
  if (options.common.json) {
    ordered_json json{{"best", nullptr},
                      {"methods", methods_json(axes, options.compare, methods)},
                      {"cells", ordered_json::array()}};
    if (best) json["best"] = cell_json(axes, *best, results.at(*best));
    for (const place::SweepCell& cell : place::all_cells(axes))
      json["cells"].push_back(cell_json(axes, cell, results.at(cell)));
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("{}", methods_text(methods_table(axes, options.compare, methods)));
  if (best) fmt::print("best:{}\n", flags_of(axes, *best));
  fmt::print("{} cells; see {}\n", results.size(), (fs::path(options.output) / "report.html").string());
}

}  // namespace retrace
