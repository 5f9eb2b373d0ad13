#include "sweep_files.hpp"

#include "json_file.hpp"
#include "methods_table.hpp"
#include "report/heat_picture.hpp"
#include "report/sweep_report.hpp"
#include "run_directory.hpp"
#include "settings_file.hpp"

#include <algorithm>
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

constexpr const char* kParts = "cells";  // folder

/// By name.
std::vector<fs::path> files_of_parts(const SweepOptions& options) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(options.output) / kParts, none))
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// What identifies a sweep; a different one may not use the same folder.
std::string description_of(const SweepOptions& options, const std::vector<place::SweepAxis>& axes) {
  std::string text =
      fmt::format("# Sweep of {} on {}\n# truth: {} {} {}, tolerance {}\n# varied:", shown(options.query),
                  shown(options.reference), options.truth.pairs, options.truth.query_truth,
                  options.truth.reference_truth, tolerance_text(options.truth.tolerance));
  for (const place::SweepAxis& axis : axes) {
    text += " " + axis.setting;
    // Densities are chosen by these (`place::sweep`).
    if (axis.setting == "motion" || (options.equal_keyframes && place::shapes_the_matrix(axis.setting)))
      text += fmt::format("={}", fmt::join(axis.values, ","));
  }
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
  const bool is_marked = fs::exists(mark);  // before it is read: another part may write it meanwhile
  place::SweepResults done;
  if (!options.common.force) {
    std::ifstream file(mark);
    const std::string before{std::istreambuf_iterator<char>(file), {}};
    if (is_marked ? before != description : fs::exists(folder / "sweep.csv")) {
      throw vo::Error(folder.string(), "holds another sweep", "another folder, or --force to begin anew");
    }
    done = place::read_sweep(folder / "sweep.csv", axes);
    for (const fs::path& part : files_of_parts(options)) done.merge(place::read_sweep(part, axes));
  } else {
    if (!options.cell.empty() || options.merge)
      throw vo::Error("--force", "would remove what other parts of the sweep wrote", "another folder");
    remove_parts(options);
    fs::remove(folder / "sweep.csv");
  }
  // The mark before the results: without it a sweep that is killed in between could not go on.
  if (options.common.force || !is_marked) vo::write_file(mark, description);
  if (options.cell.empty() && !options.merge) write_sweep_csv(options, axes, done);
  return done;
}

void write_part(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                const place::SweepPart& part, const place::SweepResults& results) {
  const fs::path folder = fs::path(options.output) / kParts;
  prepare_run_directory(folder, {}, true);
  vo::write_file(folder / fmt::format("{}-of-{}.csv", part.number, part.of), place::sweep_csv(axes, results));
}

void check_all_there(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const place::SweepResults& results) {
  const std::vector<place::SweepCell> cells = place::cells_by_work(axes);
  const auto missing =
      std::ranges::find_if_not(cells, [&](const place::SweepCell& cell) { return results.contains(cell); });
  if (missing == cells.end()) return;
  const auto count =
      std::ranges::count_if(cells, [&](const place::SweepCell& cell) { return !results.contains(cell); });
  throw vo::Error(
      options.output,
      fmt::format("{} of {} cells are missing, the first{}", count, cells.size(), flags_of(axes, *missing)),
      "every part done with --cell, or the sweep without --merge");
}

void print_part(const SweepOptions& options, const place::SweepPart& part, std::size_t found,
                std::size_t of_all) {
  if (options.common.json) {
    const ordered_json json{{"part", part.number}, {"parts", part.of}, {"cells", found}, {"of", of_all}};
    fmt::print("{}\n", json_text(json, 2));
    return;
  }
  fmt::print("part {} of {}: {} of {} cells; with all parts done, --merge puts them together\n", part.number,
             part.of, found, of_all);
}

void remove_parts(const SweepOptions& options) {
  for (const fs::path& part : files_of_parts(options)) fs::remove(part);
  std::error_code not_empty;  // holds what is not ours
  fs::remove(fs::path(options.output) / kParts, not_empty);
}

void write_sweep_csv(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const place::SweepResults& results) {
  vo::write_file(fs::path(options.output) / "sweep.csv", place::sweep_csv(axes, results));
}

void write_sweep_report(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                        const place::SweepResults& results,
                        const std::vector<place::ComparedMethod>& methods) {
  const fs::path folder = options.output;
  vo::write_file(folder / "methods.json", json_text(methods_json(axes, options.compare, methods), 2) + "\n");
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
    fmt::print("{}\n", json_text(json, 2));
    return;
  }
  fmt::print("{}", methods_text(methods_table(axes, options.compare, methods)));
  if (best) fmt::print("best:{}\n", flags_of(axes, *best));
  fmt::print("{} cells; see {}\n", results.size(), (fs::path(options.output) / "report.html").string());
}

}  // namespace retrace
