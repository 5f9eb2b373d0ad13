#include "evaluate.hpp"

#include "command.hpp"
#include "matches_file.hpp"
#include "report/run_data.hpp"
#include "report/run_report.hpp"
#include "run_directory.hpp"
#include "trajectory_metrics.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/evaluation.hpp>
#include <place/ground_truth.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct EvaluateOptions {
  CommonOptions common;
  EvaluationInputs inputs;
};

void read_ground_truth(const EvaluationInputs& inputs, RunTruth& run) {
  place::GroundTruth& truth = run.truth;
  if (!inputs.reference_truth.empty())
    truth.reference_distance_m = vo::read_truth(inputs.reference_truth).distance_m;
  if (!inputs.pairs.empty()) {
    truth.pairs = place::read_pairs(inputs.pairs);
    if (inputs.tolerance_m && truth.reference_distance_m.empty()) {
      throw vo::Error("--tolerance-m", "needs distances, which --pairs has not",
                      "--tolerance-frames, or --reference-truth beside --pairs");
    }
  } else {
    vo::WalkTruth query = vo::read_truth(inputs.query_truth);
    truth.query_distance_m = std::move(query.distance_m);
    run.poses = std::move(query.poses);
  }
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

/// What was made of each query keyframe; `retrace compare` resamples it.
std::string errors_csv(const std::vector<MatchRow>& rows, const std::vector<place::ScoredQuery>& queries) {
  std::string csv = "query_frame,query_time_s,score,accepted,has_truth,error\n";
  const auto cell = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.9g}", *value) : std::string();
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    csv += fmt::format("{},{:.6f},{},{},{},{}\n", rows[i].query_frame, rows[i].query_time_s,
                       cell(queries[i].score), rows[i].accepted ? 1 : 0, queries[i].has_truth ? 1 : 0,
                       cell(queries[i].error));
  }
  return csv;
}

void print_table(const EvaluatedRun& run, const fs::path& folder) {
  const place::Evaluation& e = run.evaluation;
  fmt::print("  {:<14}{:>10}{:>11}{:>9}{:>9}{:>7}{:>7}{:>7}\n", "", "score", "precision", "recall", "F1",
             "TP", "FP", "FN");
  for (const auto& [name, p] : {std::pair{"max-F1", e.best}, std::pair{"as accepted", run.accepted}}) {
    fmt::print("  {:<14}{:>10.4g}{:>11.3f}{:>9.3f}{:>9.3f}{:>7}{:>7}{:>7}\n", name, p.threshold, p.precision,
               p.recall, p.f1, p.true_positives, p.false_positives, p.false_negatives);
  }
  fmt::print("area under the curve {:.3f}, recall at 100 % precision {:.3f}, recall@1 {:.3f}\n", e.auc_pr,
             e.recall_at_100_precision, e.recall_at_1);
  if (e.errors)
    fmt::print("median error {:.3g} {}, 95 % within {:.3g}\n", e.errors->p50, run.unit, e.errors->p95);
  fmt::print("{} query keyframes, {} with a true place, {} matched; see {}\n", e.queries, e.with_truth,
             e.matched, (folder / "report.html").string());
}

void evaluate(const EvaluateOptions& options) {
  const EvaluatedRun run = evaluate_run(options.inputs);
  if (options.common.json) {
    fmt::print("{}\n", run.metrics.dump(2));
  } else {
    print_table(run, options.inputs.folder);
  }
}

}  // namespace

EvaluatedRun evaluate_run(const EvaluationInputs& inputs) {
  const fs::path folder = inputs.folder;
  if (!fs::is_directory(folder))
    throw vo::Error(inputs.folder, "is no folder", "one written by `retrace localise`");
  prepare_run_directory(folder, {}, true);
  const std::vector<MatchRow> rows = read_matches(folder / "matches.csv");
  RunTruth truth;
  read_ground_truth(inputs, truth);
  truth.unit = inputs.tolerance_m ? place::ErrorUnit::kMetres : place::ErrorUnit::kFrames;
  truth.tolerance = inputs.tolerance_m ? *inputs.tolerance_m : *inputs.tolerance_frames;

  std::vector<place::ScoredQuery> queries;
  for (const MatchRow& row : rows) {
    const place::PlaceError& error = truth.errors.emplace_back(
        place::place_error(truth.truth, row.query_frame, row.reference_frame, truth.unit, truth.tolerance));
    queries.push_back({.score = row.reference_frame ? std::optional(row.score) : std::nullopt,
                       .has_truth = error.has_truth,
                       .error = error.error});
  }
  truth.evaluation = place::evaluate(queries, truth.tolerance);
  if (truth.evaluation.with_truth == 0) {
    throw vo::Error(inputs.pairs.empty() ? inputs.query_truth : inputs.pairs,
                    "gives no query keyframe a true place", "the truth of this query and this reference");
  }
  truth.accepted = accepted_point(rows, queries, truth.tolerance);
  std::string unit = name_of(truth.unit);
  ordered_json metrics = metrics_json(truth.evaluation, truth.accepted, truth.tolerance, unit);
  if (!inputs.query_truth.empty()) metrics.update(trajectory_metrics(folder, inputs.query_truth));
  vo::write_file(folder / "metrics.json", metrics.dump(2) + "\n");
  vo::write_file(folder / "pr.csv", pr_csv(truth.evaluation));
  vo::write_file(folder / "errors.csv", errors_csv(rows, queries));
  vo::write_file(folder / "report.html", run_report(folder, read_run_data(folder), &truth));
  return {std::move(truth.evaluation), truth.accepted, std::move(unit), std::move(metrics)};
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
