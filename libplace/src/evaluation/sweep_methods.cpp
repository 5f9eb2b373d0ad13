#include "place/evaluation/sweep_methods.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

std::vector<std::size_t> indices_of(const std::vector<SweepAxis>& axes,
                                    const std::vector<std::string>& compared) {
  std::vector<std::size_t> indices;
  if (compared.empty()) throw vo::Error("--compare", "names nothing", "the name of a swept setting");
  for (const std::string& name : compared) {
    const auto axis = std::ranges::find(axes, name, &SweepAxis::setting);
    if (axis == axes.end())
      throw vo::Error("--compare " + name, "is not varied by this sweep", "the name of a swept setting");
    indices.push_back(static_cast<std::size_t>(axis - axes.begin()));
  }
  return indices;
}

const CellResult* result_of(const SweepResults& results, const SweepCell& cell) {
  const auto found = results.find(cell);
  return found != results.end() && found->second ? &*found->second : nullptr;
}

/// The first method with the same values as another, but for the first.
std::size_t baseline_of(const std::vector<ComparedMethod>& methods, std::size_t of) {
  const auto alike = [&](const ComparedMethod& method) {
    return std::equal(method.values.begin() + 1, method.values.end(), methods[of].values.begin() + 1);
  };
  return static_cast<std::size_t>(std::ranges::find_if(methods, alike) - methods.begin());
}

}  // namespace

void check_compared(const std::vector<SweepAxis>& axes, const std::vector<std::string>& compared) {
  indices_of(axes, compared);
}

SweepCell standard_cell(const std::vector<SweepAxis>& axes, const std::vector<std::string>& compared,
                        SweepCell cell) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto& [name, values] = axes[i];
    if (std::ranges::find(compared, name) != compared.end()) continue;
    const std::string standard(setting_named(name).standard);
    cell[i] = std::ranges::find(values, standard) != values.end() ? standard : values.front();
  }
  return cell;
}

std::vector<ComparedMethod> compare_methods(const SweepInput& input, const std::vector<SweepAxis>& axes,
                                            const std::vector<std::string>& compared,
                                            const SweepResults& results, const SweepCallbacks& callbacks,
                                            const BootstrapOptions& options) {
  const std::vector<std::size_t> indices = indices_of(axes, compared);
  std::vector<ComparedMethod> methods;
  for (const SweepCell& cell : all_cells(axes)) {
    const CellResult* const result = result_of(results, cell);
    if (result == nullptr) continue;
    SweepCell values;
    for (const std::size_t index : indices) values.push_back(cell[index]);
    auto method = std::ranges::find(methods, values, &ComparedMethod::values);
    if (method == methods.end()) {
      const SweepCell standard = standard_cell(axes, compared, cell);
      methods.push_back({.values = values, .best = {cell, *result, {}}, .standard = {standard, {}, {}}});
      continue;
    }
    if (result->max_f1 > method->best.result.max_f1) method->best = {cell, *result, {}};
  }
  std::erase_if(methods, [&](const ComparedMethod& method) {
    if (result_of(results, method.standard.cell) != nullptr) return false;
    if (callbacks.warn)
      callbacks.warn(fmt::format("{} is not compared: its default cell {} could not be run",
                                 fmt::join(method.values, " "), fmt::join(method.standard.cell, " ")));
    return true;
  });

  SweepResults run = results;
  std::vector<UncertainCell*> cells;
  for (ComparedMethod& method : methods) {
    for (UncertainCell* const cell : {&method.best, &method.standard}) {
      cells.push_back(cell);
      const auto known = run.find(cell->cell);
      if (known != run.end() && known->second->queries.queries.empty()) run.erase(known);
    }
  }
  std::vector<SweepCell> wanted;
  for (const UncertainCell* const cell : cells) wanted.push_back(cell->cell);
  if (!run_cells(input, axes, wanted, run, {.warn = callbacks.warn, .progress = callbacks.progress}))
    return {};

  std::vector<TimedQueries> queries;
  for (UncertainCell* const cell : cells) {
    cell->result = run.at(cell->cell).value();
    queries.push_back(cell->result.queries);
  }
  if (queries.empty()) return methods;
  const double tolerance = input.tolerance.tolerance_m.value_or(input.tolerance.tolerance_frames.value_or(0));
  const std::vector<RunBootstrap> drawn = bootstrap(queries, tolerance, options);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i]->interval = drawn[i].max_f1;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    methods[i].baseline = baseline_of(methods, i);
    methods[i].difference =
        paired_difference(drawn[2 * i], drawn[2 * methods[i].baseline], options.confidence);
    methods[i].with_truth = static_cast<std::size_t>(
        std::ranges::count(methods[i].best.result.queries.queries, true, &ScoredQuery::has_truth));
  }
  return methods;
}

}  // namespace place
