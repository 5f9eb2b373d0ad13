#include "evaluation/sweep_cell.hpp"

#include "match/traverse_costs.hpp"
#include "place/place.hpp"
#include "place/stage_options.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

/// The distances of the reference, where a length in metres needs them.
std::optional<Survey> survey_of(const GroundTruth& truth, const vo::Walk& reference, const Settings& given) {
  if (!given.sequence_length_m || truth.reference_distance_m.size() != reference.frames()) return {};
  Survey survey{.source = "truth", .pose = {}, .distance_m = {}, .warnings = {}};
  survey.pose.resize(reference.frames());
  for (const double metres : truth.reference_distance_m) survey.distance_m.emplace_back(metres);
  return survey;
}

std::string density_text(const Settings& settings, bool metric) {
  if (settings.every) return fmt::format("every={}", *settings.every);
  if (metric && settings.spacing_m) return fmt::format("spacing-m={:.4g}", *settings.spacing_m);
  return settings.sampling_n ? fmt::format("sampling-n={:.4g}", *settings.sampling_n) : "";
}

/// Four digits, so that a printed density repeats the run.
void multiply(std::optional<double>& value, double factor) {
  if (value) value = std::stod(fmt::format("{:.4g}", *value * factor));
}

}  // namespace

std::size_t keyframes_of(const SampledPair& sampled) {
  return sampled.query.frames.size() + sampled.route.traverses.front().keyframes.size();
}

SampledPair sample_pair(const WalkPair& walks, const Settings& given, const GroundTruth& truth) {
  SampledPair sampled;
  sampled.route = new_route(given);
  add(sampled.route, "reference", walks.reference, survey_of(truth, walks.reference, given), given);
  const Settings settings = resolve(given, {.route = &sampled.route.settings, .drop_ineffective = true});
  const StageOptions options = stage_options(settings);
  sampled.query = sample_walk(walks.query, options.sampling, &sampled.route);
  sampled.cost = cost_matrix_on_route(sampled.query, sampled.route.traverses.front(), options.matching);
  sampled.density = density_text(settings, sampled.route.metric);
  return sampled;
}

SampledPair sample_equally(const WalkPair& walks, const Settings& given, const GroundTruth& truth,
                           std::size_t target) {
  constexpr double kClose = 0.01, kEqual = 0.05;
  constexpr int kAttempts = 8;
  const Settings resolved = resolve(given, {.drop_ineffective = true});
  SampledPair best;
  double factor = 1, best_apart = 0;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Settings settings = given;
    settings.sampling_n = resolved.sampling_n;
    settings.spacing_m = resolved.spacing_m;
    multiply(settings.sampling_n, factor);
    multiply(settings.spacing_m, factor);
    SampledPair sampled = sample_pair(walks, settings, truth);
    const double ratio = static_cast<double>(keyframes_of(sampled)) / static_cast<double>(target);
    const double apart = std::abs(ratio - 1);
    if (attempt == 0 || apart < best_apart) {
      best = std::move(sampled);
      best_apart = apart;
    }
    if (best_apart <= kClose || resolved.motion == "none") return best;
    factor *= ratio;
  }
  if (best_apart > kEqual) {
    throw vo::Error(fmt::format("motion {}", *resolved.motion),
                    fmt::format("gives {} keyframes at best", keyframes_of(best)),
                    fmt::format("{} within 5 %, as with the other motions", target));
  }
  return best;
}

namespace {

/// The matches of every query on the pair's reference, with their scores.
std::vector<Match> matches_in(const SampledPair& sampled, const CostMatrix& enhanced,
                              const RouteMatchingOptions& matching, const SearchOptions& search,
                              const vo::Walk& query) {
  if (matching.openseqslam)  // the original has costs of its own
    return match_on_route(sampled.route, query.time_s, sampled.query, matching).matches;
  const Traverse& reference = sampled.route.traverses.front();
  std::vector<Match> matches;
  for (const SequenceMatch& found : search_method(matching.method).search(enhanced, search).matches) {
    Match& match = matches.emplace_back();
    match.query_frame = static_cast<std::int64_t>(sampled.query.frames[matches.size() - 1]);
    match.score = found.score;
    if (found.reference) match.place.emplace().frame = reference.keyframes[*found.reference].frame;
  }
  return matches;
}

}  // namespace

std::optional<CellResult> run_cell(const SampledPair& sampled, const CostMatrix& enhanced,
                                   const RouteMatchingOptions& matching, const WalkPair& walks,
                                   const GroundTruth& truth, const Tolerance& tolerance) {
  const Traverse& reference = sampled.route.traverses.front();
  const SearchOptions search = search_on_route(reference, walks.query.time_s, sampled.query, matching);
  if (enhanced.references < static_cast<std::size_t>(search.sequence.length)) return {};
  CellResult result{.query_keyframes = enhanced.queries, .reference_keyframes = enhanced.references};
  for (const std::size_t frame : sampled.query.frames)
    result.queries.time_s.push_back(walks.query.time_s[frame]);
  const std::vector<Match> matches = matches_in(sampled, enhanced, matching, search, walks.query);
  RunEvaluation run = evaluate(matches, truth, tolerance);
  const Evaluation& e = run.evaluation;
  result.max_f1 = e.best.f1;
  result.max_f1_threshold = e.best.threshold;
  result.precision = e.best.precision;
  result.recall = e.best.recall;
  result.auc_pr = e.auc_pr;
  result.recall_at_100_precision = e.recall_at_100_precision;
  result.recall_at_1 = e.recall_at_1;
  result.density = sampled.density;
  result.queries.queries = std::move(run.queries);
  return as_written(std::move(result));
}

}  // namespace place
