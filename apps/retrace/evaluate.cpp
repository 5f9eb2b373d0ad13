#include "evaluate.hpp"

#include "command.hpp"
#include "report/page.hpp"
#include "run_directory.hpp"
#include "trajectory_metrics.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/evaluation.hpp>
#include <place/ground_truth.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::string_view kCounting =
    "Every query keyframe with a true place counts in recall's denominator, matched or not. Accepted and "
    "within tolerance "
    "is a true positive; accepted and not is a false positive, also where the query has no true place; the "
    "rest with a "
    "true place are false negatives. Every distinct score is a threshold.";

struct EvaluateOptions {
  CommonOptions common;
  EvaluationInputs inputs;
};

/// A row of matches.csv, as far as evaluation needs it.
struct MatchRow {
  std::int64_t query_frame = 0;
  std::optional<std::int64_t> reference_frame;
  double score = 0;
  bool accepted = false;
};

std::vector<MatchRow> read_matches(const fs::path& path) {
  const vo::CsvTable table = vo::CsvTable::read(path);
  const std::vector<std::int64_t> query = table.indices("query_frame");
  const std::vector<std::optional<double>> reference = table.optional_numbers("reference_frame");
  const std::vector<std::optional<double>> score = table.optional_numbers("score");
  const std::vector<std::int64_t> accepted = table.indices("accepted");
  if (table.rows() == 0) throw vo::Error(path.string(), "has no rows", "one for each query keyframe");
  std::vector<MatchRow> rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    MatchRow row{.query_frame = query[i],
                 .reference_frame = {},
                 .score = score[i].value_or(0),
                 .accepted = accepted[i] != 0};
    if (reference[i]) {
      if (!score[i])
        throw vo::Error(table.where(i), "has a reference frame and no score", "a score for every match");
      row.reference_frame = static_cast<std::int64_t>(*reference[i]);
    }
    rows.push_back(row);
  }
  return rows;
}

place::GroundTruth read_ground_truth(const EvaluationInputs& inputs) {
  place::GroundTruth truth;
  if (!inputs.reference_truth.empty())
    truth.reference_distance_m = vo::read_truth(inputs.reference_truth).distance_m;
  if (!inputs.pairs.empty()) {
    truth.pairs = place::read_pairs(inputs.pairs);
    if (inputs.tolerance_m && truth.reference_distance_m.empty()) {
      throw vo::Error("--tolerance-m", "needs distances, which --pairs has not",
                      "--tolerance-frames, or --reference-truth beside --pairs");
    }
  } else {
    truth.query_distance_m = vo::read_truth(inputs.query_truth).distance_m;
  }
  return truth;
}

ordered_json point_json(const place::OperatingPoint& point) {
  return {{"threshold", point.threshold},
          {"true_positives", point.true_positives},
          {"false_positives", point.false_positives},
          {"false_negatives", point.false_negatives},
          {"precision", point.precision},
          {"recall", point.recall},
          {"f1", point.f1}};
}

/// The run's own acceptance, which need not be a plain threshold.
place::OperatingPoint accepted_point(const std::vector<MatchRow>& rows,
                                     const std::vector<place::ScoredQuery>& queries, double tolerance) {
  std::vector<place::ScoredQuery> accepted = queries;
  double least = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].accepted) accepted[i].score.reset();
    if (rows[i].accepted) least = least == 0 ? rows[i].score : std::min(least, rows[i].score);
  }
  return place::operating_point(accepted, tolerance, least);
}

ordered_json metrics_json(const place::Evaluation& evaluation, const place::OperatingPoint& accepted,
                          double tolerance, std::string_view unit) {
  ordered_json json{{"queries", evaluation.queries},
                    {"with_truth", evaluation.with_truth},
                    {"without_truth", evaluation.queries - evaluation.with_truth},
                    {"matched", evaluation.matched},
                    {"matched_without_truth", evaluation.matched_without_truth},
                    {"tolerance", tolerance},
                    {"unit", unit},
                    {"max_f1", evaluation.best.f1},
                    {"max_f1_threshold", evaluation.best.threshold},
                    {"precision", evaluation.best.precision},
                    {"recall", evaluation.best.recall},
                    {"auc_pr", evaluation.auc_pr},
                    {"recall_at_100_precision", evaluation.recall_at_100_precision},
                    {"recall_at_1", evaluation.recall_at_1},
                    {"true_positives", evaluation.best.true_positives},
                    {"false_positives", evaluation.best.false_positives},
                    {"false_negatives", evaluation.best.false_negatives},
                    {"accepted", point_json(accepted)},
                    {"error", nullptr},
                    {"counting", kCounting}};
  if (const auto& e = evaluation.errors) {
    json["error"] = {{"p50", e->p50}, {"p75", e->p75}, {"p90", e->p90},
                     {"p95", e->p95}, {"p99", e->p99}, {"max", e->max}};
  }
  return json;
}

std::string pr_csv(const place::Evaluation& evaluation) {
  std::string csv = "threshold,precision,recall,f1,true_positives,false_positives,false_negatives\n";
  for (const place::OperatingPoint& p : evaluation.curve) {
    csv += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{},{},{}\n", p.threshold, p.precision, p.recall, p.f1,
                       p.true_positives, p.false_positives, p.false_negatives);
  }
  return csv;
}

std::string report(const fs::path& folder, const place::Evaluation& evaluation,
                   const place::OperatingPoint& accepted, const ordered_json& metrics,
                   std::string_view unit) {
  const auto point_row = [](std::string name, const place::OperatingPoint& p) {
    return std::vector<std::string>{std::move(name),
                                    fmt::format("{:.4g}", p.threshold),
                                    fmt::format("{:.3f}", p.precision),
                                    fmt::format("{:.3f}", p.recall),
                                    fmt::format("{:.3f}", p.f1),
                                    std::to_string(p.true_positives),
                                    std::to_string(p.false_positives),
                                    std::to_string(p.false_negatives)};
  };
  const std::vector<std::string> point_header{"", "threshold", "precision", "recall", "F1", "TP", "FP", "FN"};

  Page page("Precision and recall", folder.string());
  page.facts(
      {{"Max-F1", fmt::format("{:.3f}", evaluation.best.f1)},
       {"Area under the curve", fmt::format("{:.3f}", evaluation.auc_pr)},
       {"Recall at 100 % precision", fmt::format("{:.3f}", evaluation.recall_at_100_precision)},
       {"Recall@1", fmt::format("{:.3f}", evaluation.recall_at_1)},
       {"Tolerance", fmt::format("{} {}", metrics["tolerance"].get<double>(), unit)},
       {"Query keyframes", fmt::format("{}, of them {} with a true place, {} matched", evaluation.queries,
                                       evaluation.with_truth, evaluation.matched)}});
  if (std::ifstream file(folder / "summary.json"); file) {
    const auto summary = ordered_json::parse(file, nullptr, false);
    if (!summary.is_discarded() && summary.contains("partial") && summary.contains("partial_accepted")) {
      page.facts({{"On part of a line",
                   fmt::format("{}, of them accepted {} (within half a sequence of an end of either walk)",
                               summary["partial"].dump(), summary["partial_accepted"].dump())}});
    }
  }
  page.heading("Operating points");
  page.table(point_header, {point_row("best F1", evaluation.best), point_row("as accepted", accepted)});
  page.heading("How it was counted");
  page.paragraph(kCounting);
  if (const auto& e = evaluation.errors) {
    page.heading("Errors of all matches with a true place");
    page.table({"unit", "median", "75 %", "90 %", "95 %", "99 %", "largest"},
               {{std::string(unit), fmt::format("{:.3g}", e->p50), fmt::format("{:.3g}", e->p75),
                 fmt::format("{:.3g}", e->p90), fmt::format("{:.3g}", e->p95), fmt::format("{:.3g}", e->p99),
                 fmt::format("{:.3g}", e->max)}});
  }
  if (std::ifstream file(folder / "cost_matrix.png", std::ios::binary); file) {
    const std::vector<std::uint8_t> png{std::istreambuf_iterator<char>(file), {}};
    page.heading("Cost matrix");
    page.picture(png, "Enhanced cost matrix with the matches over it",
                 "Query keyframes from left to right, reference keyframes from bottom to top, dark where "
                 "alike. Filled "
                 "orange: accepted. Hollow blue: refused.");
  }
  page.heading("Precision-recall curve");
  page.paragraph("At most 40 of its points; all of them are in pr.csv.");
  std::vector<std::vector<std::string>> rows;
  const std::size_t step = std::max<std::size_t>(1, (evaluation.curve.size() + 39) / 40);
  for (std::size_t i = 0; i < evaluation.curve.size(); i += step)
    rows.push_back(point_row(std::to_string(i + 1), evaluation.curve[i]));
  page.table(point_header, rows);
  return page.html();
}

void evaluate(const EvaluateOptions& options) {
  const auto [evaluation, accepted, unit, metrics] = evaluate_run(options.inputs);
  if (options.common.json) {
    fmt::print("{}\n", metrics.dump(2));
    return;
  }
  fmt::print("max-F1 {:.3f} (precision {:.3f}, recall {:.3f} at score {:.4g})\n", evaluation.best.f1,
             evaluation.best.precision, evaluation.best.recall, evaluation.best.threshold);
  fmt::print("as accepted: precision {:.3f}, recall {:.3f}\n", accepted.precision, accepted.recall);
  fmt::print("area under the curve {:.3f}, recall at 100 % precision {:.3f}, recall@1 {:.3f}\n",
             evaluation.auc_pr, evaluation.recall_at_100_precision, evaluation.recall_at_1);
  if (evaluation.errors) {
    fmt::print("median error {:.3g} {}, 95 % within {:.3g}\n", evaluation.errors->p50, unit,
               evaluation.errors->p95);
  }
  if (metrics.contains("ape_rmse_m") && !metrics["ape_rmse_m"].is_null()) {
    fmt::print("trajectory: APE {:.2f} m rmse, {:.2f} m at the end", metrics["ape_rmse_m"].get<double>(),
               metrics["ape_end_m"].get<double>());
    if (!metrics["ape_odometry_rmse_m"].is_null())
      fmt::print(" (odometry alone {:.2f} m, {:.2f} m)", metrics["ape_odometry_rmse_m"].get<double>(),
                 metrics["ape_odometry_end_m"].get<double>());
    fmt::print("; RPE {:.3f} m\n", metrics["rpe_rmse_m"].get<double>());
  }
  fmt::print("{} query keyframes, {} with a true place, {} matched; see {}\n", evaluation.queries,
             evaluation.with_truth, evaluation.matched,
             (fs::path(options.inputs.folder) / "report.html").string());
}

}  // namespace

EvaluatedRun evaluate_run(const EvaluationInputs& inputs) {
  const fs::path folder = inputs.folder;
  if (!fs::is_directory(folder))
    throw vo::Error(inputs.folder, "is no folder", "one written by `retrace localise`");
  prepare_run_directory(folder, {}, true);
  const std::vector<MatchRow> rows = read_matches(folder / "matches.csv");
  const place::GroundTruth truth = read_ground_truth(inputs);
  const bool metres = inputs.tolerance_m.has_value();
  const double tolerance = metres ? *inputs.tolerance_m : *inputs.tolerance_frames;
  std::string unit = metres ? "metres" : "reference frames";

  std::vector<place::ScoredQuery> queries;
  for (const MatchRow& row : rows) {
    const place::PlaceError error =
        place::place_error(truth, row.query_frame, row.reference_frame,
                           metres ? place::ErrorUnit::kMetres : place::ErrorUnit::kFrames, tolerance);
    queries.push_back({.score = row.reference_frame ? std::optional(row.score) : std::nullopt,
                       .has_truth = error.has_truth,
                       .error = error.error});
  }
  place::Evaluation evaluation = place::evaluate(queries, tolerance);
  if (evaluation.with_truth == 0) {
    throw vo::Error(inputs.pairs.empty() ? inputs.query_truth : inputs.pairs,
                    "gives no query keyframe a true place", "the truth of this query and this reference");
  }
  const place::OperatingPoint accepted = accepted_point(rows, queries, tolerance);
  ordered_json metrics = metrics_json(evaluation, accepted, tolerance, unit);
  if (!inputs.query_truth.empty()) metrics.update(trajectory_metrics(folder, inputs.query_truth));
  vo::write_file(folder / "metrics.json", metrics.dump(2) + "\n");
  vo::write_file(folder / "pr.csv", pr_csv(evaluation));
  vo::write_file(folder / "report.html", report(folder, evaluation, accepted, metrics, unit));
  return {std::move(evaluation), accepted, std::move(unit), std::move(metrics)};
}

Command add_evaluate(CLI::App& root) {
  auto options = std::make_shared<EvaluateOptions>();
  CLI::App* app = root.add_subcommand("evaluate", "precision, recall and errors of a run against the truth");
  app->add_option("run", options->inputs.folder, "folder written by `retrace localise`")->required();
  auto* truth = app->add_option_group("truth", "where the query truly was");
  truth->add_option("--pairs", options->inputs.pairs,
                    "landmarks: query_frame,reference_frame, interpolated between them");
  CLI::Option* query =
      truth->add_option("--query-truth", options->inputs.query_truth, "truth.csv of the query");
  truth->require_option(1);
  CLI::Option* reference =
      app->add_option("--reference-truth", options->inputs.reference_truth, "truth.csv of the reference");
  query->needs(reference);
  auto* tolerance = app->add_option_group("tolerance", "how far off is still right");
  tolerance->add_option("--tolerance-m", options->inputs.tolerance_m, "metres along the route [SSS 4.2: 4]")
      ->check(CLI::NonNegativeNumber);
  tolerance->add_option("--tolerance-frames", options->inputs.tolerance_frames, "reference frames")
      ->check(CLI::NonNegativeNumber);
  tolerance->require_option(1);
  add_json_option(*app, options->common);
  app->add_flag("--force", options->common.force,
                "accepted for symmetry: results of an evaluation are always renewed")
      ->group("General");
  app->footer(
      "Examples:\n"
      "  retrace evaluate run --pairs pairs.csv --tolerance-frames 17\n"
      "  retrace evaluate run --query-truth night.csv --reference-truth day.csv --tolerance-m 4");
  return {app, [options] { evaluate(*options); }};
}

}  // namespace retrace
