#include "compare_report.hpp"

#include "report/page.hpp"
#include "report/path_charts.hpp"
#include "report/pr_chart.hpp"
#include "report/run_data.hpp"
#include "report/run_pictures.hpp"
#include "report/run_report.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace retrace {
namespace {

Chart curves(const Comparison& comparison) {
  Chart chart = precision_recall_plane();
  std::vector<Series> all;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    Series curve = styled(precision_recall_curve(comparison.runs[i].name, comparison.runs[i].evaluation), i);
    curve.size_px = 3;
    all.push_back(std::move(curve));
  }
  chart.series.insert(chart.series.begin(), all.begin(), all.end());
  return chart;
}

/// One line per run, its max-F1 marked on its interval.
Chart intervals(const Comparison& comparison) {
  const auto count = static_cast<double>(comparison.runs.size());
  Chart chart{.title = "max-F1 of each run with its confidence interval",
              .x_title = "max-F1",
              .y_title = "",
              .y_range = std::array{0.0, count + 1},
              .size = comparison.runs.size() < 5 ? "wide" : ""};
  double low = 1;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const ComparedRun& run = comparison.runs[i];
    const double f1 = run.evaluation.best.f1;
    const place::Interval interval = run.bootstrap.max_f1.value_or(place::Interval{f1, f1});
    const double line = count - static_cast<double>(i);
    low = std::min(low, interval.low);
    chart.y_names.insert(chart.y_names.begin(), run.name);
    chart.series.push_back(styled({.name = run.name,
                                   .x = {interval.low, f1, interval.high},
                                   .y = {line, line, line},
                                   .width_px = 3,
                                   .size_px = 5,
                                   .bar_ends = true,
                                   .notes = {"lower end", "of the whole run", "upper end"}},
                                  i));
  }
  chart.x_range = {std::max(0.0, low - 0.02), 1.01};
  return chart;
}

/// The matrices, paths and keyframes of all runs beside each other (SSS Fig. 6, 7).
void put_paths(Page& page, const Comparison& comparison) {
  std::vector<nlohmann::ordered_json> data;
  std::vector<RunView> views;
  data.reserve(comparison.runs.size());  // views keep references
  views.reserve(comparison.runs.size());
  std::vector<NamedRun> runs;
  for (const ComparedRun& run : comparison.runs) {
    if (!std::filesystem::exists(std::filesystem::path(run.folder) / "matches.csv")) continue;
    data.push_back(read_run_data(run.folder));
    views.push_back(read_run(run.folder, data.back(), nullptr));
    std::vector<std::optional<double>> true_frame = read_true_frames(run.folder);
    if (true_frame.size() == views.back().matches.size()) views.back().true_frame = std::move(true_frame);
    runs.push_back({run.name, &views.back()});
  }
  page.chart(
      "Paths and keyframes", path_chart(runs),
      "The path that each search has to find, by its own keyframes: the true one where it is known. The "
      "straighter it is, the fewer lines and the longer sequences will do [SSS Fig. 7].");
  page.chart("", sampling_chart(runs),
             "Where on the route the keyframes lie: dense where a walker is slow, unless he is sampled by "
             "distance [SSS Fig. 6].");
  bool any = false;
  for (const auto& [name, view] : runs) {
    for (const MatrixFigure& matrix : matrix_figures(*view)) {
      if (!any) page.heading("Cost matrices");
      if (!any) page.begin_row();
      any = true;
      page.matrix(matrix.json, fmt::format("{}, against {}", name, matrix.traverse));
    }
  }
  if (any) page.end_row();
}

std::string verdict(const place::PairedDifference& difference, const ComparedRun& run,
                    const ComparedRun& other) {
  if (!difference.interval) return "a single segment: no telling";
  if (difference.interval->low > 0) return run.name + " is better";
  if (difference.interval->high < 0) return other.name + " is better";
  return "could be chance";
}

}  // namespace

std::string with_interval(double value, const std::optional<place::Interval>& interval) {
  if (!interval) return fmt::format("{:.3f}", value);
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", value, interval->low, interval->high);
}

std::string compare_report(const Comparison& comparison) {
  Page page("Runs compared", fmt::format("right is within {:g} {}", comparison.tolerance, comparison.unit));
  std::vector<Headline> headlines;
  for (const ComparedRun& run : comparison.runs) {
    const auto& interval = run.bootstrap.max_f1;
    headlines.push_back(
        {run.name, fmt::format("{:.3f}", run.evaluation.best.f1),
         interval ? fmt::format("max-F1, {:.3f} to {:.3f}", interval->low, interval->high) : "max-F1"});
  }
  page.headlines(headlines);
  page.heading("Precision and recall");
  page.chart(curves(comparison), "Every point is a threshold; dashed lines join points of equal F1.");
  page.heading("How sure the figures are");
  page.chart(intervals(comparison), "The line is the confidence interval.");
  std::vector<std::vector<std::string>> rows;
  for (const ComparedRun& run : comparison.runs) {
    const place::Evaluation& e = run.evaluation;
    const place::RunBootstrap& b = run.bootstrap;
    rows.push_back({run.name, std::to_string(e.with_truth), with_interval(e.best.f1, b.max_f1),
                    with_interval(e.auc_pr, b.auc_pr),
                    with_interval(e.recall_at_100_precision, b.recall_at_100_precision),
                    with_interval(e.recall_at_1, b.recall_at_1),
                    e.errors ? fmt::format("{:.3g}", e.errors->p50) : ""});
  }
  page.table({"run", "queries", "max-F1", "area under the curve", "recall at 100 % precision", "recall@1",
              "median error, " + comparison.unit},
             rows);
  page.paragraph(
      fmt::format("Intervals hold {:g} % of {} resamples. Neighbouring keyframes are right or wrong "
                  "together, so whole segments of "
                  "{:g} s of walk are drawn, the same for all runs (seed {}). Few segments make wide "
                  "intervals, and a run that is "
                  "never wrong has none to tell of: it could still be wrong elsewhere.",
                  100 * comparison.options.confidence, comparison.options.resamples,
                  comparison.options.segment_s, comparison.options.seed));
  page.heading("Differences of max-F1");
  rows.clear();
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    for (std::size_t k = i + 1; k < comparison.runs.size(); ++k) {
      const ComparedRun &run = comparison.runs[k], &other = comparison.runs[i];
      const auto difference =
          place::paired_difference(run.bootstrap, other.bootstrap, comparison.options.confidence);
      rows.push_back({run.name + " − " + other.name,
                      with_interval(run.evaluation.best.f1 - other.evaluation.best.f1, difference.interval),
                      fmt::format("{:.1f} %", 100 * difference.share_above),
                      verdict(difference, run, other)});
    }
  }
  page.table({"runs", "difference", "resamples in which it is above 0", "so"}, rows);
  put_paths(page, comparison);
  page.heading("How it was counted");
  page.paragraph(kCounting);
  std::vector<std::pair<std::string, std::string>> folders;
  for (const ComparedRun& run : comparison.runs) folders.emplace_back(run.name, run.folder);
  page.facts(folders);
  return page.html();
}

}  // namespace retrace
