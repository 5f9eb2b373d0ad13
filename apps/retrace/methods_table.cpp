#include "methods_table.hpp"

#include "report/compare_report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kFewQueries = 50;  // under which nothing is called better

/// "search-range-rad 0.4, enhance local": the values of a cell that do not make the method.
std::string others(const std::vector<place::SweepAxis>& axes, const std::vector<std::string>& compared,
                   const place::SweepCell& cell) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (std::ranges::find(compared, axes[i].setting) == compared.end())
      parts.push_back(fmt::format("{} {}", axes[i].setting, cell[i]));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

ordered_json interval_json(const std::optional<place::Interval>& interval) {
  return interval ? ordered_json{interval->low, interval->high} : ordered_json(nullptr);
}

ordered_json cell_json(const std::vector<place::SweepAxis>& axes, const place::UncertainCell& cell) {
  ordered_json json;
  for (std::size_t i = 0; i < axes.size(); ++i) json[axes[i].setting] = cell.cell[i];
  json.update({{"density", cell.result.density},
               {"query_keyframes", cell.result.query_keyframes},
               {"reference_keyframes", cell.result.reference_keyframes},
               {"max_f1", cell.result.max_f1},
               {"max_f1_interval", interval_json(cell.interval)}});
  return json;
}

}  // namespace

MethodsTable methods_table(const std::vector<place::SweepAxis>& axes,
                           const std::vector<std::string>& compared,
                           const std::vector<place::ComparedMethod>& methods) {
  MethodsTable table;
  table.header = compared;
  for (const char* const name : {"sampled", "keyframes", "default", "best", "best at"})
    table.header.emplace_back(name);
  if (!methods.empty())
    table.header.push_back(fmt::format("gain on {} {}", compared.front(), methods.front().values.front()));
  for (const place::ComparedMethod& method : methods) {
    std::vector<std::string>& row = table.rows.emplace_back(method.values);
    const place::CellResult& best = method.best.result;
    row.push_back(best.density);
    row.push_back(fmt::format("{} x {}", best.query_keyframes, best.reference_keyframes));
    row.push_back(with_interval(method.standard.result.max_f1, method.standard.interval));
    row.push_back(with_interval(best.max_f1, method.best.interval));
    row.push_back(others(axes, compared, method.best.cell));
    const place::ComparedMethod& baseline = methods[method.baseline];
    const double gain = best.max_f1 - baseline.best.result.max_f1;
    row.push_back(&method == &baseline ? "" : with_interval(gain, method.difference.interval));
    if (method.with_truth < kFewQueries) {
      table.note = fmt::format("{} queries with truth, under {}: too few to call a method better",
                               method.with_truth, kFewQueries);
    }
  }
  return table;
}

ordered_json methods_json(const std::vector<place::SweepAxis>& axes, const std::vector<std::string>& compared,
                          const std::vector<place::ComparedMethod>& methods) {
  ordered_json json = ordered_json::array();
  for (const place::ComparedMethod& method : methods) {
    ordered_json& row = json.emplace_back();
    for (std::size_t i = 0; i < compared.size(); ++i) row["method"][compared[i]] = method.values[i];
    row["with_truth"] = method.with_truth;
    row["best"] = cell_json(axes, method.best);
    row["default"] = cell_json(axes, method.standard);
    row["baseline"] = method.baseline;
    row["difference"] = method.best.result.max_f1 - methods[method.baseline].best.result.max_f1;
    row["difference_interval"] = interval_json(method.difference.interval);
  }
  return json;
}

std::string methods_text(const MethodsTable& table) {
  std::string text = fmt::format("| {} |\n|", fmt::join(table.header, " | "));
  for (std::size_t i = 0; i < table.header.size(); ++i) text += "---|";
  text += "\n";
  for (const std::vector<std::string>& row : table.rows)
    text += fmt::format("| {} |\n", fmt::join(row, " | "));
  if (!table.note.empty()) text += table.note + "\n";
  return text;
}

}  // namespace retrace
