#include "evaluation_files.hpp"

#include "json_file.hpp"
#include "report/run_data.hpp"
#include "report/run_report.hpp"
#include "report/run_view.hpp"
#include "run_directory.hpp"
#include "trajectory_metrics.hpp"

#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/match/match_io.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv_columns.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using place::OperatingPoint;

ordered_json point_json(const OperatingPoint& point) {
  return {{"threshold", point.threshold},
          {"tp", point.true_positives},
          {"fp", point.false_positives},
          {"fn", point.false_negatives},
          {"precision", point.precision},
          {"recall", point.recall},
          {"f1", point.f1}};
}

ordered_json metrics_json(const place::RunEvaluation& run) {
  const place::Evaluation& evaluation = run.evaluation;
  ordered_json json{{"queries", evaluation.queries},
                    {"with_truth", evaluation.with_truth},
                    {"without_truth", evaluation.queries - evaluation.with_truth},
                    {"matched", evaluation.matched},
                    {"matched_without_truth", evaluation.matched_without_truth},
                    {"tolerance", run.tolerance},
                    {"unit", name_of(run.unit)},
                    {"tp", evaluation.best.true_positives},
                    {"fp", evaluation.best.false_positives},
                    {"fn", evaluation.best.false_negatives},
                    {"max_f1", evaluation.best.f1},
                    {"max_f1_threshold", evaluation.best.threshold},
                    {"precision", evaluation.best.precision},
                    {"recall", evaluation.best.recall},
                    {"auc_pr", evaluation.auc_pr},
                    {"recall_at_100_precision", evaluation.recall_at_100_precision},
                    {"recall_at_1", evaluation.recall_at_1},
                    {"accepted", point_json(run.accepted)},
                    {"calibration_error", nullptr},
                    {"error", nullptr},
                    {"counting", kCounting}};
  if (run.calibration) {
    json["calibration_error"] = run.calibration->error;
    for (const place::ReliabilityBin& bin : run.calibration->bins) {
      json["reliability"].push_back({{"matches", bin.matches},
                                     {"lowest", bin.lowest},
                                     {"highest", bin.highest},
                                     {"mean", bin.mean},
                                     {"right", bin.right}});
    }
  }
  if (const auto& e = evaluation.errors) {
    json["error"] = {{"p50", e->p50}, {"p75", e->p75}, {"p90", e->p90},
                     {"p95", e->p95}, {"p99", e->p99}, {"max", e->max}};
  }
  return json;
}

std::string nine(double value) {
  return fmt::format("{:.9g}", value);
}

constexpr std::array kCurveColumns{
    vo::CsvColumn<OperatingPoint>{"threshold", [](const OperatingPoint& p) { return nine(p.threshold); }},
    vo::CsvColumn<OperatingPoint>{"precision", [](const OperatingPoint& p) { return nine(p.precision); }},
    vo::CsvColumn<OperatingPoint>{"recall", [](const OperatingPoint& p) { return nine(p.recall); }},
    vo::CsvColumn<OperatingPoint>{"f1", [](const OperatingPoint& p) { return nine(p.f1); }},
    vo::CsvColumn<OperatingPoint>{"tp",
                                  [](const OperatingPoint& p) { return std::to_string(p.true_positives); }},
    vo::CsvColumn<OperatingPoint>{"fp",
                                  [](const OperatingPoint& p) { return std::to_string(p.false_positives); }},
    vo::CsvColumn<OperatingPoint>{"fn",
                                  [](const OperatingPoint& p) { return std::to_string(p.false_negatives); }},
};

/// A row of errors.csv: the result for a query keyframe. `retrace compare` resamples it.
struct ErrorRow {
  std::int64_t query_frame = 0;
  double query_time_s = 0;
  bool accepted = false;
  place::ScoredQuery query;
  std::optional<double> true_frame;
};

// Every digit: some errors lie on the tolerance.
std::string cell_of(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}

bool read_optional(std::string_view cell, std::optional<double>& value) {
  value = vo::parse_number(cell);
  return value || cell.empty();
}

using ErrorColumn = vo::CsvColumn<ErrorRow>;
constexpr const char* kNumber = "a finite number";
constexpr std::array kErrorColumns{
    ErrorColumn{"query_frame", [](const ErrorRow& r) { return fmt::format("{}", r.query_frame); }},
    ErrorColumn{"query_time_s", [](const ErrorRow& r) { return fmt::format("{:.6f}", r.query_time_s); },
                [](ErrorRow& r, std::string_view cell) {
                  r.query_time_s = vo::parse_number(cell).value_or(0);
                  return vo::parse_number(cell).has_value();
                },
                kNumber},
    ErrorColumn{"score", [](const ErrorRow& r) { return cell_of(r.query.score); },
                [](ErrorRow& r, std::string_view cell) { return read_optional(cell, r.query.score); },
                kNumber},
    ErrorColumn{"accepted", [](const ErrorRow& r) { return std::string(r.accepted ? "1" : "0"); }},
    ErrorColumn{"has_truth", [](const ErrorRow& r) { return std::string(r.query.has_truth ? "1" : "0"); },
                [](ErrorRow& r, std::string_view cell) {
                  r.query.has_truth = cell == "1";
                  return cell == "0" || cell == "1";
                },
                "0 or 1"},
    ErrorColumn{"error", [](const ErrorRow& r) { return cell_of(r.query.error); },
                [](ErrorRow& r, std::string_view cell) { return read_optional(cell, r.query.error); },
                kNumber},
    ErrorColumn{"true_frame", [](const ErrorRow& r) { return cell_of(r.true_frame); }},
};

std::string errors_csv(const std::vector<place::Match>& matches, const RunTruth& run) {
  std::vector<ErrorRow> rows;
  for (std::size_t i = 0; i < matches.size(); ++i)
    rows.push_back({matches[i].query_frame, matches[i].query_time_s, matches[i].accepted, run.queries[i],
                    true_frame(run.truth, matches[i].query_frame)});
  return vo::to_csv<ErrorRow>(rows, kErrorColumns);
}

}  // namespace

fs::path evaluation_page(const fs::path& folder) {
  return folder / (fs::exists(folder / "follow.jsonl") ? "evaluation.html" : "report.html");
}

std::pair<place::RunEvaluation, ordered_json> evaluate_folder(const fs::path& folder,
                                                              const TruthOptions& options) {
  check_written_by("localise", folder);
  prepare_run_directory(folder, {}, true);
  const std::vector<place::Match> matches = place::read_matches(folder / "matches.csv");
  Truth known = read_truth(options);
  RunTruth truth;
  static_cast<place::RunEvaluation&>(truth) = place::evaluate(matches, known.places, options.tolerance);
  truth.truth = std::move(known.places);
  truth.poses = std::move(known.poses);
  if (truth.evaluation.with_truth == 0) {
    throw vo::Error(truth_file(options), "gives no query keyframe a true place",
                    "the truth of this query and this reference");
  }
  ordered_json metrics = metrics_json(truth);
  if (!options.query_truth.empty()) metrics.update(trajectory_metrics(folder, options.query_truth));
  StagedFiles staged(folder);
  vo::write_file(staged.path() / "metrics.json", json_text(metrics, 2) + "\n");
  vo::write_file(staged.path() / "pr.csv", vo::to_csv<OperatingPoint>(truth.evaluation.curve, kCurveColumns));
  vo::write_file(staged.path() / "errors.csv", errors_csv(matches, truth));
  vo::write_file(staged.path() / evaluation_page(folder).filename(),
                 run_report(folder, read_run_data(folder), &truth));
  staged.commit();
  return {std::move(truth), std::move(metrics)};
}

place::TimedQueries read_errors(const fs::path& folder) {
  const fs::path file = folder / "errors.csv";
  if (!fs::exists(file))
    throw vo::Error(folder.string(), "has no errors.csv", "a run that `retrace evaluate` has evaluated");
  place::TimedQueries run;
  for (ErrorRow& row : vo::read_csv<ErrorRow>(file, kErrorColumns)) {
    run.time_s.push_back(row.query_time_s);
    run.queries.push_back(row.query);
  }
  return run;
}

std::pair<double, std::string> read_tolerance(const fs::path& folder) {
  const ordered_json json = read_json_object(folder / "metrics.json");
  const std::optional<double> tolerance = number_in(json, "tolerance");
  const std::optional<std::string> unit = text_in(json, "unit");
  if (!tolerance || !(*tolerance >= 0) || !unit)
    throw vo::Error((folder / "metrics.json").string(), "has no tolerance",
                    "one written by `retrace evaluate`");
  return {*tolerance, *unit};
}

}  // namespace retrace
