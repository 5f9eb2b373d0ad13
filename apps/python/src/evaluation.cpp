#include "arrays.hpp"
#include "bindings.hpp"
#include "unlocked.hpp"

#include <cmath>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <vector>

#include <place/evaluation/bootstrap.hpp>
#include <place/evaluation/calibration.hpp>
#include <place/evaluation/evaluation.hpp>
#include <place/place.hpp>

namespace retrace_python {
namespace {

void check_lengths(const Doubles& a, const Doubles& b) {
  if (a.ndim() != 1 || b.ndim() != 1 || a.size() != b.size())
    throw py::value_error("arrays of one dimension and one length expected");
}

/// `place`: the matched place, NaN or below 0 for none. `truth`: the true one, NaN for none.
std::vector<place::ScoredQuery> scored(const Doubles& place, const Doubles& score, const Doubles& truth) {
  check_lengths(place, score);
  check_lengths(place, truth);
  std::vector<place::ScoredQuery> queries;
  for (py::ssize_t i = 0; i < place.size(); ++i) {
    place::ScoredQuery& query = queries.emplace_back();
    const bool matched = !std::isnan(place.at(i)) && place.at(i) >= 0;
    query.has_truth = !std::isnan(truth.at(i));
    if (matched) query.score = score.at(i);
    if (matched && query.has_truth) query.error = std::abs(place.at(i) - truth.at(i));
  }
  return queries;
}

py::dict as_dict(const place::Evaluation& e) {
  py::dict result;
  result["queries"] = e.queries;
  result["with_truth"] = e.with_truth;
  result["tp"] = e.best.true_positives;
  result["fp"] = e.best.false_positives;
  result["fn"] = e.best.false_negatives;
  result["max_f1"] = e.best.f1;
  result["max_f1_threshold"] = e.best.threshold;
  result["precision"] = e.best.precision;
  result["recall"] = e.best.recall;
  result["auc_pr"] = e.auc_pr;
  result["recall_at_100_precision"] = e.recall_at_100_precision;
  result["recall_at_1"] = e.recall_at_1;
  py::dict curve;
  curve["threshold"] = array_of<double>(e.curve, [](const auto& p) { return p.threshold; });
  curve["precision"] = array_of<double>(e.curve, [](const auto& p) { return p.precision; });
  curve["recall"] = array_of<double>(e.curve, [](const auto& p) { return p.recall; });
  result["curve"] = curve;
  return result;
}

py::dict evaluate_matches(const Doubles& place, const Doubles& score, const Doubles& truth,
                          double tolerance) {
  return as_dict(place::evaluate(scored(place, score, truth), tolerance));
}

py::dict evaluate(const place::Run& run, const std::string& query_truth, const std::string& reference_truth,
                  const std::string& pairs, std::optional<double> tolerance_m,
                  std::optional<double> tolerance_frames) {
  if (pairs.empty() ? query_truth.empty() || reference_truth.empty() : !query_truth.empty())
    throw py::value_error("pairs, or query_truth and reference_truth, expected");
  place::GroundTruth truth;
  if (pairs.empty()) {
    truth = place::truth(query_truth, reference_truth);
  } else {
    truth.pairs = place::read_pairs(pairs);
    if (!reference_truth.empty()) truth.reference_distance_m = place::distances_on(reference_truth);
  }
  const place::RunEvaluation found =
      place::evaluate(run, truth, {.tolerance_m = tolerance_m, .tolerance_frames = tolerance_frames});
  py::dict result = as_dict(found.evaluation);
  result["accepted_precision"] = found.accepted.precision;
  result["accepted_recall"] = found.accepted.recall;
  result["calibration_error"] =
      found.calibration ? py::object(py::float_(found.calibration->error)) : py::object(py::none());
  result["error"] = array_of<double>(found.errors, [](const auto& error) { return or_nan(error.error); });
  return result;
}

py::object interval(const std::optional<place::Interval>& of) {
  if (!of) return py::none();
  return py::make_tuple(of->low, of->high);
}

py::list bootstrap(const std::vector<std::tuple<Doubles, Doubles, Doubles, Doubles>>& runs, double tolerance,
                   int resamples, double segment_s, double confidence, std::uint64_t seed) {
  std::vector<place::TimedQueries> timed;
  for (const auto& [time_s, place, score, truth] : runs) {
    check_lengths(time_s, place);
    timed.push_back({{time_s.data(), time_s.data() + time_s.size()}, scored(place, score, truth)});
  }
  const place::BootstrapOptions options{
      .resamples = resamples, .segment_s = segment_s, .confidence = confidence, .seed = seed};
  const std::vector<place::RunBootstrap> found =
      unlocked([&] { return place::bootstrap(timed, tolerance, options); });
  py::list all;
  for (const place::RunBootstrap& run : found) {
    py::dict one;
    one["max_f1"] = interval(run.max_f1);
    one["auc_pr"] = interval(run.auc_pr);
    one["recall_at_100_precision"] = interval(run.recall_at_100_precision);
    one["recall_at_1"] = interval(run.recall_at_1);
    one["max_f1_of"] = array_of(run.max_f1_of);
    const place::PairedDifference difference = place::paired_difference(run, found.front(), confidence);
    one["max_f1_above_first"] = interval(difference.interval);
    all.append(one);
  }
  return all;
}

double calibration_error(const Doubles& probability,
                         const py::array_t<bool, py::array::c_style | py::array::forcecast>& right,
                         int bins) {
  if (probability.ndim() != 1 || right.ndim() != 1 || probability.size() != right.size())
    throw py::value_error("arrays of one dimension and one length expected");
  std::vector<place::ProbableMatch> matches;
  for (py::ssize_t i = 0; i < probability.size(); ++i) {
    if (!std::isnan(probability.at(i))) matches.push_back({probability.at(i), right.at(i)});
  }
  return place::calibration(matches, bins).error;
}

}  // namespace

void bind_evaluation(py::module_& module) {
  module.def("evaluate_matches", &evaluate_matches, py::arg("place"), py::arg("score"), py::arg("truth"),
             py::arg("tolerance"),
             "Precision and recall over all thresholds of the score. `place`: float64 (queries,), the "
             "matched place (a reference "
             "index, frame or metres), NaN or below 0 for none; `truth`: the true one in the same unit, NaN "
             "where there is none. "
             "A dict like metrics.json, with the `curve` as arrays.");
  module.def("evaluate", &evaluate, py::arg("run"), py::kw_only(), py::arg("query_truth") = "",
             py::arg("reference_truth") = "", py::arg("pairs") = "", py::arg("tolerance_m") = py::none(),
             py::arg("tolerance_frames") = py::none(),
             "Precision, recall and errors of a run against truth.csv of both walks, or pairs.csv; a dict "
             "like metrics.json, with the `curve` as arrays.");
  module.def("bootstrap", &bootstrap, py::arg("runs"), py::arg("tolerance"), py::kw_only(),
             py::arg("resamples") = 2000, py::arg("segment_s") = 10.0, py::arg("confidence") = 0.95,
             py::arg("seed") = 1,
             "Intervals of several runs of one walk, by segments of it drawn together. `runs`: a list of "
             "(time_s, place, score, "
             "truth) as for `evaluate_matches`. A list of dicts of (low, high), None for a walk of a single "
             "segment; "
             "`max_f1_above_first` is the paired difference from the first run.");
  module.def("calibration_error", &calibration_error, py::arg("probability"), py::arg("right"),
             py::arg("bins") = 10,
             "Expected calibration error in bins of equal counts; entries of NaN are left out.");
}

}  // namespace retrace_python
