#include "run_report.hpp"

#include "report/page.hpp"
#include "report/path_charts.hpp"
#include "report/run_charts.hpp"
#include "report/run_pictures.hpp"
#include "report/settings_table.hpp"

#include <fmt/format.h>

namespace retrace {
namespace {

namespace fs = std::filesystem;

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100 * share);
}

std::string acceptance(const RunCounts& counts) {
  if (counts.accept_score) return fmt::format("score {:g} or more", *counts.accept_score);
  if (counts.accept_probability) return fmt::format("probability {:g} or more", *counts.accept_probability);
  return "as on the route";
}

void put_counts(Page& page, const RunCounts& counts) {
  std::vector<Headline> numbers{
      {"Query keyframes", std::to_string(counts.queries), fmt::format("of {} frames", counts.query_frames)},
      {"Accepted", std::to_string(counts.accepted), acceptance(counts)},
      {"Refused", std::to_string(counts.matched - counts.accepted), "matched, less sure"}};
  if (counts.sequence_length)
    numbers.push_back({"Sequence", std::to_string(*counts.sequence_length), "keyframes on a line"});
  if (counts.relative_scale)
    numbers.push_back({"Relative scale", fmt::format("{:.3f}", *counts.relative_scale),
                       "of the query's motion to the route's"});
  page.headlines(numbers);
  if (counts.partial)
    page.paragraph(
        fmt::format("{} matches, {} of them accepted, were found on part of a line: within half a "
                    "sequence of an end of either walk.",
                    *counts.partial, counts.partial_accepted.value_or(0)));
  for (const std::string& warning : counts.warnings) page.warning(warning);
}

void put_scores(Page& page, const RunTruth& truth) {
  const place::Evaluation& e = truth.evaluation;
  const std::string unit = truth.unit == place::ErrorUnit::kMetres ? "m" : "frames";
  std::vector<Headline> numbers{
      {"Max-F1", fmt::format("{:.3f}", e.best.f1), fmt::format("at score {:.4g}", e.best.threshold)},
      {"Precision", percent(e.best.precision), "at max-F1"},
      {"Recall", percent(e.best.recall), "at max-F1"},
      {"Area under the curve", fmt::format("{:.3f}", e.auc_pr), "average precision"},
      {"Recall", percent(e.recall_at_100_precision), "at 100 % precision"},
      {"Recall@1", percent(e.recall_at_1), "every match taken"}};
  if (truth.calibration)
    numbers.push_back(
        {"Calibration error", fmt::format("{:.3f}", truth.calibration->error), "of probabilities"});
  if (e.errors) {
    numbers.push_back({"Median error", fmt::format("{:.3g} {}", e.errors->p50, unit),
                       fmt::format("95 % within {:.3g} {}", e.errors->p95, unit)});
  }
  page.headlines(numbers);
  page.paragraph(
      fmt::format("{} query keyframes, of them {} with a true place, {} matched. Right is within {:g} {} of "
                  "the true place.",
                  e.queries, e.with_truth, e.matched, truth.tolerance, name_of(truth.unit)));
}

void put_operating_points(Page& page, const RunTruth& truth) {
  const auto row = [](std::string name, const place::OperatingPoint& p) {
    return std::vector<std::string>{std::move(name),
                                    fmt::format("{:.4g}", p.threshold),
                                    fmt::format("{:.3f}", p.precision),
                                    fmt::format("{:.3f}", p.recall),
                                    fmt::format("{:.3f}", p.f1),
                                    std::to_string(p.true_positives),
                                    std::to_string(p.false_positives),
                                    std::to_string(p.false_negatives)};
  };
  page.table({"", "threshold", "precision", "recall", "F1", "TP", "FP", "FN"},
             {row("best F1", truth.evaluation.best), row("as accepted", truth.accepted)});
  if (const auto& e = truth.evaluation.errors) {
    page.table({"errors of all matches", "median", "75 %", "90 %", "95 %", "99 %", "largest"},
               {{name_of(truth.unit), fmt::format("{:.3g}", e->p50), fmt::format("{:.3g}", e->p75),
                 fmt::format("{:.3g}", e->p90), fmt::format("{:.3g}", e->p95), fmt::format("{:.3g}", e->p99),
                 fmt::format("{:.3g}", e->max)}});
  }
}

}  // namespace

const std::string_view kCounting =
    "TP: accepted and within tolerance of the true place. FP: accepted and not, also where the query has no "
    "true place. FN: with a true place and no TP, whether refused, unmatched or wrong. "
    "Precision = TP / (TP + FP), recall = TP / (TP + FN). Every distinct score is a threshold.";

std::string name_of(place::ErrorUnit unit) {
  return unit == place::ErrorUnit::kMetres ? "metres" : "reference frames";
}

std::string run_report(const fs::path& folder, const nlohmann::ordered_json& data, const RunTruth* truth) {
  const RunView view = read_run(folder, data, truth);
  Page page(truth != nullptr ? "Where the walk was found, and how well" : "Where the walk was found",
            view.counts ? fmt::format("{} on {}", view.counts->query, view.counts->route) : folder.string());
  if (truth != nullptr) put_scores(page, *truth);
  if (view.counts) put_counts(page, *view.counts);
  if (truth != nullptr) {
    page.chart(
        "Precision and recall", precision_recall_chart(*truth),
        "Every point is a threshold of the score. The star is the threshold of the highest F1, the diamond "
        "the run's own acceptance; dashed lines join points of equal F1.");
    put_operating_points(page, *truth);
    page.chart(
        "How far probabilities can be trusted", reliability_chart(*truth),
        "Matches in ten groups of about equal probability: the share that was right against the mean "
        "probability. On the dashed line a probability means what it says; above it, matches are surer "
        "than they claim.");
    page.chart("Error along the walk", error_chart(view),
               "Errors beyond the upper edge are drawn on it; hover for their values.");
  } else {
    page.paragraph("Precision, recall and errors need the truth: retrace evaluate.");
  }
  page.chart("Score along the walk", score_chart(view), "A higher score is a surer match.");
  for (const MatrixFigure& matrix : matrix_figures(view)) {
    page.heading(fmt::format("Cost matrix against {}", matrix.traverse));
    page.matrix(
        matrix.json,
        "Dark where alike. Raw: mean absolute difference of the descriptors; enhanced: as it was searched. "
        "Drag or use the arrows to move, + and - (or the wheel with Ctrl) to zoom.");
  }
  page.chart("Speed, before and after normalisation", speed_chart(view),
             "Before: travelled displacement in a second, over a second about each moment.");
  page.chart(
      "", keyframe_chart(view),
      "After: displacement between neighbouring keyframes, in units of the sampling: constant, but where the "
      "walker covers more than a unit between two frames.");
  page.chart(
      "", straightness_chart(view),
      "The path that a search has to find, of accepted matches or the true one: wavy by time, as it is "
      "with every so many frames, and straighter by keyframes a distance apart [SSS Fig. 7].");
  page.chart(
      "", sampling_chart(view),
      "Where on the route the keyframes of both walks lie, and where as many would lie at a fixed rate: "
      "dense where a walker is slow [SSS Fig. 6].");
  page.chart(
      "", spacing_chart(view),
      "Metres truly walked between neighbouring keyframes. The closer the two walks, the straighter the path "
      "through the matrix, and the nearer to 45 degrees.");
  if (const std::optional<std::string> strip = strip_json(view)) {
    page.heading("What was taken for the same place");
    page.strip(*strip, "Query above, the place of the route where it was found below.");
  }
  page.chart("Map", map_chart(view), "Metres, in the coordinates of the route.");
  if (truth != nullptr) {
    page.heading("How it was counted");
    page.paragraph(kCounting);
  }
  put_settings(page, folder / "config.toml");
  return page.html();
}

}  // namespace retrace
