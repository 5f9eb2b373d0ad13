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

#include <place/evaluation/evaluation.hpp>
#include <place/evaluation/ground_truth.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct EvaluateOptions {
  CommonOptions common;
  EvaluationInputs inputs;
};

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
    return value ? fmt::format("{}", *value)
                 : std::string();  // every digit: some errors lie on the tolerance
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
  RunTruth truth = read_truth(inputs.truth);
  std::vector<place::ScoredQuery> queries;
  for (const MatchRow& row : rows)
    queries.push_back(judge(truth, row.query_frame, row.reference_frame, row.score));
  truth.evaluation = place::evaluate(queries, truth.tolerance);
  if (truth.evaluation.with_truth == 0) {
    throw vo::Error(truth_file(inputs.truth), "gives no query keyframe a true place",
                    "the truth of this query and this reference");
  }
  truth.accepted = accepted_point(rows, queries, truth.tolerance);
  std::string unit = name_of(truth.unit);
  ordered_json metrics = metrics_json(truth.evaluation, truth.accepted, truth.tolerance, unit);
  if (!inputs.truth.query_truth.empty()) metrics.update(trajectory_metrics(folder, inputs.truth.query_truth));
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
  add_truth_options(*app, options->inputs.truth);
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
