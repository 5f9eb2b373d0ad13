#include "sweep_report.hpp"

#include "report/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace retrace {
namespace {

constexpr std::size_t kMotion = 0, kLength = 1, kRange = 2, kFurther = 3;

double max_f1(const place::SweepResults& results, const place::SweepCell& cell) {
  const auto found = results.find(cell);
  return found != results.end() && found->second ? found->second->max_f1 : NAN;
}

/// A value as a number if all values of the axis are numbers, else its index.
double position(const place::SweepAxis& axis, std::size_t i) {
  const auto number = [](const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return *end == '\0' ? value : NAN;
  };
  const bool numeric =
      std::ranges::none_of(axis.values, [&](const std::string& v) { return std::isnan(number(v)); });
  return numeric ? number(axis.values[i]) : static_cast<double>(i);
}

/// Max-F1 along one axis through a cell, with its values on the other axes.
Series along(const std::vector<place::SweepAxis>& axes, const place::SweepResults& results,
             place::SweepCell cell, std::size_t axis, std::string name, std::size_t style) {
  Series series = styled({.name = std::move(name), .size_px = 4.5}, style);
  for (std::size_t i = 0; i < axes[axis].values.size(); ++i) {
    cell[axis] = axes[axis].values[i];
    series.x.push_back(position(axes[axis], i));
    series.y.push_back(max_f1(results, cell));
    series.notes.push_back(fmt::format("{} {}", axes[axis].setting, cell[axis]));
  }
  return series;
}

std::array<double, 2> f1_range(const place::SweepResults& results) {
  double low = 1;
  for (const auto& [cell, result] : results) low = std::min(low, result ? result->max_f1 : 1.0);
  return {std::max(0.0, std::floor(10 * low - 0.5) / 10), 1.02};
}

std::vector<std::string> result_cells(const std::optional<place::CellResult>& r) {
  if (!r) return std::vector<std::string>(7, "–");
  return {fmt::format("{} x {}", r->query_keyframes, r->reference_keyframes),
          fmt::format("{:.3f}", r->max_f1),
          fmt::format("{:.3f}", r->precision),
          fmt::format("{:.3f}", r->recall),
          fmt::format("{:.3f}", r->auc_pr),
          fmt::format("{:.3f}", r->recall_at_100_precision),
          fmt::format("{:.3f}", r->recall_at_1)};
}

void put_table(Page& page, const std::vector<place::SweepAxis>& axes, const place::SweepResults& results,
               const std::vector<place::SweepCell>& cells) {
  std::vector<std::string> header;
  for (const place::SweepAxis& axis : axes) header.push_back(axis.setting);
  for (const char* name :
       {"keyframes", "max-F1", "precision", "recall", "AUC", "recall at 100 %", "recall@1"})
    header.emplace_back(name);
  std::vector<std::vector<std::string>> rows;
  for (const place::SweepCell& cell : cells) {
    const auto found = results.find(cell);
    if (found == results.end()) continue;
    rows.push_back(cell);
    for (std::string& text : result_cells(found->second)) rows.back().push_back(std::move(text));
  }
  page.table(header, rows);
}

void put_curves(Page& page, const std::vector<place::SweepAxis>& axes, const place::SweepResults& results,
                const place::SweepCell& best) {
  for (const std::size_t axis : {kRange, kLength}) {
    const std::size_t other = axis == kRange ? kLength : kRange;
    if (axes[axis].values.size() < 2) continue;
    Chart chart{.title = fmt::format("max-F1 against {}, motion {}", axes[axis].setting, best[kMotion]),
                .x_title = axes[axis].setting,
                .y_title = "max-F1, motion " + best[kMotion],
                .y_range = f1_range(results)};
    for (std::size_t i = 0; i < axes[other].values.size(); ++i) {
      place::SweepCell cell = best;
      cell[other] = axes[other].values[i];
      chart.series.push_back(
          along(axes, results, cell, axis, fmt::format("{} {}", axes[other].setting, cell[other]), i));
    }
    page.chart(chart, "");
  }
}

}  // namespace

std::optional<place::SweepCell> best_cell(const std::vector<place::SweepAxis>& axes,
                                          const place::SweepResults& results, const std::string& motion) {
  std::optional<place::SweepCell> best;
  for (const place::SweepCell& cell : place::all_cells(axes)) {
    if (!motion.empty() && cell[kMotion] != motion) continue;
    const double f1 = max_f1(results, cell);
    if (!std::isnan(f1) && (!best || f1 > max_f1(results, *best))) best = cell;
  }
  return best;
}

std::vector<HeatTable> heat_tables(const std::vector<place::SweepAxis>& axes,
                                   const place::SweepResults& results) {
  std::vector<HeatTable> tables;
  for (const std::string& motion : axes[kMotion].values) {
    std::optional<place::SweepCell> cell = best_cell(axes, results, motion);
    if (!cell) continue;
    HeatTable table{.title = fmt::format("max-F1, motion {}", motion),
                    .row_title = "length",
                    .column_title = "search range, rad",
                    .rows = axes[kLength].values,
                    .columns = axes[kRange].values};
    for (std::size_t i = kFurther; i < axes.size(); ++i)
      table.title += fmt::format(", {} {}", axes[i].setting, (*cell)[i]);
    for (const std::string& length : table.rows) {
      std::vector<double>& row = table.values.emplace_back();
      for (const std::string& range : table.columns) {
        (*cell)[kLength] = length;
        (*cell)[kRange] = range;
        row.push_back(max_f1(results, *cell));
      }
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

std::string sweep_report(const std::vector<place::SweepAxis>& axes, const place::SweepResults& results,
                         const std::string& subtitle,
                         const std::vector<std::pair<std::string, std::string>>& facts,
                         const MethodsTable& methods) {
  Page page("Which settings find the walk", subtitle);
  const std::optional<place::SweepCell> best = best_cell(axes, results);
  std::vector<place::SweepCell> best_of_motions;
  for (const std::string& motion : axes[kMotion].values) {
    if (const std::optional<place::SweepCell> cell = best_cell(axes, results, motion))
      best_of_motions.push_back(*cell);
  }
  if (best) {
    std::vector<Headline> headlines{
        {"Highest max-F1", fmt::format("{:.3f}", max_f1(results, *best)), "of all cells"}};
    for (std::size_t i = 0; i < axes.size(); ++i)
      headlines.push_back({axes[i].setting, (*best)[i], "in that cell"});
    page.headlines(headlines);
  }
  page.facts(facts);
  page.heading("Each method at its best");
  page.table(methods.header, methods.rows);
  page.paragraph(
      "Beside its default; in brackets, 95 of 100 resamples of the walk's stretches, the same for all "
      "methods. "
      "The best was chosen on this walk, and is somewhat lower on another. " +
      methods.note);
  page.heading("The best of each motion source");
  put_table(page, axes, results, best_of_motions);
  page.heading("Sequence length and search range");
  page.paragraph("The darker, the higher; the star is the highest of a table [SSS Fig. 8].");
  page.heat_tables(heat_tables(axes, results));
  for (const place::SweepCell& cell : best_of_motions) put_curves(page, axes, results, cell);
  for (std::size_t i = kFurther; i < axes.size(); ++i) {
    if (axes[i].values.size() < 2) continue;  // nothing to draw it against
    page.heading(axes[i].setting);
    Chart chart{.title = "max-F1 against " + axes[i].setting,
                .x_title = axes[i].setting,
                .y_title = "max-F1",
                .y_range = f1_range(results),
                .size = "wide"};
    for (std::size_t m = 0; m < best_of_motions.size(); ++m)
      chart.series.push_back(
          along(axes, results, best_of_motions[m], i, "motion " + best_of_motions[m][kMotion], m));
    page.chart(chart, "The other settings as in the best cell of each motion source.");
  }
  page.heading("All cells");
  put_table(page, axes, results, place::all_cells(axes));
  page.heading("How it was counted");
  page.paragraph(kCounting);
  return page.html();
}

}  // namespace retrace
