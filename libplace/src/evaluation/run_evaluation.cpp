#include "place/evaluation/run_evaluation.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <vo/base/error.hpp>
#include <vo/io/trajectory_io.hpp>

namespace place {
namespace {

/// The run's own acceptance, which may not be a plain threshold.
OperatingPoint accepted_point(std::span<const Match> matches, const RunEvaluation& run) {
  std::vector<ScoredQuery> accepted = run.queries;
  std::optional<double> least;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches[i].accepted) {
      accepted[i].score.reset();
    } else {
      least = std::min(least.value_or(matches[i].score), matches[i].score);
    }
  }
  return operating_point(accepted, run.tolerance, least.value_or(0));
}

}  // namespace

std::vector<double> distances_on(const std::filesystem::path& reference_truth) {
  std::vector<double> distance_m = vo::distances_between(vo::read_truth(reference_truth));
  if (distance_m.empty())
    throw vo::Error(reference_truth.string(), "knows no distance", "distance_m of two frames or more");
  return distance_m;
}

GroundTruth truth(const std::filesystem::path& query_truth, const std::filesystem::path& reference_truth) {
  return {.pairs = {},
          .query_distance_m = vo::read_truth(query_truth).distance_m,
          .reference_distance_m = distances_on(reference_truth)};
}

RunEvaluation evaluate(std::span<const Match> matches, const GroundTruth& truth, const Tolerance& tolerance) {
  if (tolerance.tolerance_m.has_value() == tolerance.tolerance_frames.has_value())
    throw std::invalid_argument("evaluate: a tolerance in metres or in frames expected");
  RunEvaluation run;
  run.unit = tolerance.tolerance_m ? ErrorUnit::kMetres : ErrorUnit::kFrames;
  run.tolerance = tolerance.tolerance_m ? *tolerance.tolerance_m : *tolerance.tolerance_frames;
  for (const Match& match : matches) {
    const std::optional<std::int64_t> reference =
        match.place ? std::optional(match.place->frame) : std::nullopt;
    const PlaceError& error =
        run.errors.emplace_back(place_error(truth, match.query_frame, reference, run.unit, run.tolerance));
    run.queries.push_back({.score = match.place ? std::optional(match.score) : std::nullopt,
                           .has_truth = error.has_truth,
                           .error = error.error});
  }
  run.evaluation = evaluate(run.queries, run.tolerance);
  run.accepted = accepted_point(matches, run);
  std::vector<ProbableMatch> probable;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches[i].probability) continue;
    const std::optional<double>& error = run.queries[i].error;
    probable.push_back({*matches[i].probability, error && *error <= run.tolerance});
  }
  if (!probable.empty()) run.calibration = calibration(probable);
  return run;
}

}  // namespace place
