#include "place/evaluation/sweep_grid.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>

namespace place {
namespace {

/// A column of sweep.csv.
struct Column {
  const char* name;
  double CellResult::*value;
};

constexpr std::array kColumns{Column{"max_f1", &CellResult::max_f1},
                              Column{"max_f1_threshold", &CellResult::max_f1_threshold},
                              Column{"precision", &CellResult::precision},
                              Column{"recall", &CellResult::recall},
                              Column{"auc_pr", &CellResult::auc_pr},
                              Column{"recall_at_100_precision", &CellResult::recall_at_100_precision},
                              Column{"recall_at_1", &CellResult::recall_at_1}};

/// Settings that may change from cell to cell: all but those that do not affect precision and recall, and
/// those of a file that both walks would share.
bool can_vary(const Setting& setting) {
  constexpr std::array kNotHere{"threads",
                                "accept-score",
                                "accept-probability",
                                "correct-drift",
                                "fuse-traverses",
                                "view-points",
                                "verify",
                                "preview-width-px",
                                "motion-file",
                                "candidates",
                                "motion-file-unit",
                                "motion-file-start-s",
                                "motion-file-gap-s",
                                "descriptor-file",
                                "axes"};
  return std::ranges::find(kNotHere, setting.name) == kNotHere.end();
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::string row(const SweepCell& cell, const std::optional<CellResult>& result) {
  std::string text = fmt::format("{}", fmt::join(cell, ","));
  text += result ? fmt::format(",{},{}", result->query_keyframes, result->reference_keyframes) : ",,";
  text += "," + (result ? result->density : "");
  for (const Column& column : kColumns)
    text += result ? fmt::format(",{:.9g}", (*result).*column.value) : ",";
  return text + "\n";
}

}  // namespace

SweepAxis parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  SweepAxis axis;
  if (equals != std::string::npos) {
    axis = {text.substr(0, equals), split(text.substr(equals + 1))};
    axis.setting.erase(0, std::min(axis.setting.find_first_not_of('-'), axis.setting.size()));
  }
  if (axis.setting.empty() || axis.values.empty())
    throw vo::Error("--vary " + text, "is no setting with values", "NAME=a,b,c");
  return axis;
}

std::vector<SweepCell> all_cells(const std::vector<SweepAxis>& axes) {
  std::vector<SweepCell> cells{{}};
  for (const SweepAxis& axis : axes) {
    std::vector<SweepCell> longer;
    for (const SweepCell& cell : cells) {
      for (const std::string& value : axis.values) {
        longer.push_back(cell);
        longer.back().push_back(value);
      }
    }
    cells = std::move(longer);
  }
  return cells;
}

Settings settings_at(const Settings& base, const std::vector<SweepAxis>& axes, const SweepCell& cell) {
  Settings settings = base;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Setting& setting = setting_named(axes[i].setting);
    if (!can_vary(setting))
      throw vo::Error("--vary " + axes[i].setting, "cannot vary", "a setting of sampling or search");
    set(settings, setting, cell[i]);
  }
  if (settings.motion == "file")
    throw vo::Error("motion=file", "cannot be swept", "a motion that both walks show themselves");
  return settings;
}

bool shapes_the_matrix(const std::string& setting) {
  // With `compat`, max-shift-px and enhance have no effect.
  return setting_named(setting).group != SettingGroup::kSearch || setting == "max-shift-px" ||
         setting == "compat";
}

CellResult as_written(CellResult result) {
  for (const Column& column : kColumns)
    result.*column.value = vo::parse_number(fmt::format("{:.9g}", result.*column.value)).value_or(0);
  return result;
}

std::string sweep_csv(const std::vector<SweepAxis>& axes, const SweepResults& results) {
  std::string csv;
  for (const SweepAxis& axis : axes) csv += axis.setting + ",";
  csv += "query_keyframes,reference_keyframes,density";
  for (const Column& column : kColumns) csv += fmt::format(",{}", column.name);
  csv += "\n";
  SweepResults left = results;
  for (const SweepCell& cell : all_cells(axes)) {
    const auto found = left.find(cell);
    if (found == left.end()) continue;
    csv += row(cell, found->second);
    left.erase(found);
  }
  for (const auto& [cell, result] : left) csv += row(cell, result);
  return csv;
}

SweepResults read_sweep(const std::filesystem::path& path, const std::vector<SweepAxis>& axes) {
  SweepResults results;
  if (!std::filesystem::exists(path)) return results;
  const vo::CsvTable table = vo::CsvTable::read(path);
  std::vector<SweepCell> cells(table.rows());
  for (const SweepAxis& axis : axes) {
    if (!table.has(axis.setting))
      throw vo::Error(path.string(), fmt::format("is of a sweep that did not vary {}", axis.setting),
                      "the same axes, another folder, or --force to begin anew");
    const std::vector<std::string> values = table.text(axis.setting);
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i].push_back(values[i]);
  }
  constexpr std::size_t kOthers = 3 + kColumns.size();  // two counts and the density
  if (table.header().size() != axes.size() + kOthers)
    throw vo::Error(path.string(), "is of a sweep of other settings",
                    "the same axes, another folder, or --force to begin anew");
  const auto query = table.optional_numbers("query_keyframes");
  const auto reference = table.optional_numbers("reference_keyframes");
  const std::vector<std::string> density = table.text("density");
  std::vector<std::optional<CellResult>> read(table.rows());
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (!query[i] || !reference[i]) continue;
    read[i] = CellResult{.query_keyframes = static_cast<std::size_t>(*query[i]),
                         .reference_keyframes = static_cast<std::size_t>(*reference[i])};
    read[i]->density = density[i];
  }
  for (const Column& column : kColumns) {
    const auto values = table.optional_numbers(column.name);
    for (std::size_t i = 0; i < read.size(); ++i) {
      if (read[i]) (*read[i]).*column.value = values[i].value_or(0);
    }
  }
  for (std::size_t i = 0; i < read.size(); ++i) results[cells[i]] = read[i];
  return results;
}

}  // namespace place
