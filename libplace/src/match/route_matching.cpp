#include "place/match/route_matching.hpp"

#include "match/joined_traverses.hpp"
#include "match/traverse_costs.hpp"
#include "place/match/walk_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

void check_long_enough(const Traverse& traverse, int length) {
  if (traverse.keyframes.size() >= static_cast<std::size_t>(length)) return;
  throw vo::Error(fmt::format("traverse '{}'", traverse.name),
                  fmt::format("has {} keyframes, the sequence {}", traverse.keyframes.size(), length),
                  "a reference at least as long as the sequence; walk further or lower sequence-length");
}

/// Matches of the original's search, whose scores lie in [0, 1] and are lower for surer ones.
std::vector<SureMatch> search_the_original_way(const SampledWalk& sampled, const Traverse& traverse,
                                               std::size_t index, openseqslam::Options options, int length,
                                               const SearchCallback& callback) {
  options.sequence_length = length;
  const vo::ImageStack* const reference = thumbnails_of(traverse);
  if (reference == nullptr) {
    throw vo::Error(fmt::format("traverse '{}'", traverse.name), "was built without thumbnails",
                    "a route built with descriptor thumbnail, or with previews");
  }
  const CostMatrix cost =
      openseqslam::difference_matrix(openseqslam::patch_normalise(sampled.thumbnails, options),
                                     openseqslam::patch_normalise(*reference, options), options);
  const CostMatrix enhanced = openseqslam::enhance(cost, options);
  if (callback) {
    const std::vector<std::size_t> columns = counted(traverse.keyframes.size());
    callback({index, false, block_of(cost), columns});
    callback({index, true, block_of(enhanced), columns});
  }
  std::vector<SureMatch> matches;
  for (const openseqslam::Match& found : openseqslam::find_matches(enhanced, options)) {
    SequenceMatch match{.reference = found.reference, .terms = length};
    if (found.reference) match.score = 1 - found.score;
    matches.push_back({.match = match, .probability = {}, .sd_keyframes = {}});
  }
  return matches;
}

/// The walk's displacement between its keyframes, in keyframes of the traverse; empty where either has none.
std::vector<double> keyframe_steps(const SampledWalk& sampled, const Traverse& traverse) {
  constexpr double kLongestStep = 1000;  // `PathSearchOptions::is_valid`
  const double there = traverse.keyframes.back().displacement - traverse.keyframes.front().displacement;
  if (sampled.displacement.empty() || !(there > 0)) return {};
  const double unit = there / static_cast<double>(traverse.keyframes.size() - 1);
  std::vector<double> steps(sampled.frames.size(), 0.0);
  for (std::size_t q = 1; q < steps.size(); ++q) {
    for (std::size_t frame = sampled.frames[q - 1] + 1; frame <= sampled.frames[q]; ++frame)
      steps[q] += sampled.displacement[frame] / unit;
    steps[q] = std::clamp(steps[q], 0.0, kLongestStep);
  }
  return steps;
}

/// Metres along the route between a keyframe's neighbours, per keyframe; none unless surveyed.
std::optional<double> local_spacing_m(const Traverse& traverse, std::size_t keyframe) {
  const std::size_t before = keyframe - std::min<std::size_t>(keyframe, 1);
  const std::size_t after = std::min(traverse.keyframes.size() - 1, keyframe + 1);
  const Keyframe &a = traverse.keyframes[before], &b = traverse.keyframes[after];
  if (before == after || !a.distance_m || !b.distance_m) return {};
  return std::abs(*b.distance_m - *a.distance_m) / static_cast<double>(after - before);
}

Place place_of(const Traverse& traverse, std::size_t keyframe) {
  const Keyframe& k = traverse.keyframes[keyframe];
  return {.traverse = traverse.name,
          .keyframe = keyframe,
          .frame = k.frame,
          .time_s = k.time_s,
          .distance_m = k.distance_m,
          .pose = k.pose};
}

/// Whether a match is accepted.
bool is_accepted(const Match& match, const RouteMatchingOptions& options) {
  constexpr double kScore = 0.7;  // for lines, in deviations: for walks too short for probabilities
  if (options.accept_score || !match.probability) return match.score >= options.accept_score.value_or(kScore);
  return *match.probability >= options.accept_probability;
}

/// Takes a traverse's matches where they are the surest so far; returns how many.
std::size_t take_surest(const std::vector<SureMatch>& found, const Traverse& traverse,
                        const std::vector<std::size_t>& columns, int length,
                        const RouteMatchingOptions& options, std::vector<Match>& matches) {
  std::size_t taken = 0;
  for (std::size_t q = 0; q < found.size(); ++q) {
    const auto& [sequence, probability, sd_keyframes] = found[q];
    Match& match = matches[q];
    if (!sequence.reference) continue;
    const auto score = static_cast<double>(sequence.score);
    if (match.place &&
        std::pair(match.probability.value_or(0), match.score) >= std::pair(probability.value_or(0), score)) {
      continue;
    }
    const std::size_t keyframe = columns[*sequence.reference];
    match.place = place_of(traverse, keyframe);
    match.score = score;
    match.probability = probability;
    match.sd_keyframes = sd_keyframes;
    const std::optional<double> spacing_m = local_spacing_m(traverse, keyframe);
    match.sd_m = sd_keyframes && spacing_m ? std::optional(*sd_keyframes * *spacing_m) : std::nullopt;
    match.partial = sequence.terms < length;
    match.accepted = is_accepted(match, options);
    ++taken;
  }
  return taken;
}

}  // namespace

std::vector<std::size_t> gaps_between(const std::vector<std::size_t>& columns,
                                      const std::vector<std::size_t>& gaps) {
  std::vector<std::size_t> among;
  for (std::size_t k = 1; k < columns.size(); ++k) {
    if (columns[k] != columns[k - 1] + 1 || std::ranges::binary_search(gaps, columns[k])) among.push_back(k);
  }
  return among;
}

SearchOptions search_on_route(const Traverse& traverse, std::span<const double> time_s,
                              const SampledWalk& sampled, const RouteMatchingOptions& options) {
  SearchOptions search{.sequence = options.search,
                       .graph = {},
                       .path = {},
                       .gaps = {.query = gaps_at(sampled.frames, time_s), .reference = gaps_of(traverse)}};
  search.sequence.length = sequence_length_on(traverse, options);
  search.path.steps = keyframe_steps(sampled, traverse);
  return search;
}

RouteMatches match_on_route(const Route& route, std::span<const double> time_s, const SampledWalk& sampled,
                            const RouteMatchingOptions& options, const SearchCallback& callback) {
  if (route.traverses.empty()) throw std::invalid_argument("match_on_route: the route has no traverse");
  RouteMatches result;
  for (const std::size_t frame : sampled.frames) {
    result.matches.push_back(
        {.query_frame = static_cast<std::int64_t>(frame), .query_time_s = time_s[frame], .place = {}});
  }
  std::vector<int> lengths;
  for (const Traverse& traverse : route.traverses) {
    lengths.push_back(sequence_length_on(traverse, options));
    check_long_enough(traverse, lengths.back());
  }
  result.sequence_length = lengths.back();
  if (options.openseqslam) {
    for (std::size_t i = 0; i < route.traverses.size(); ++i) {
      const Traverse& traverse = route.traverses[i];
      const auto found =
          search_the_original_way(sampled, traverse, i, *options.openseqslam, lengths[i], callback);
      take_surest(found, traverse, counted(traverse.keyframes.size()), lengths[i], options, result.matches);
    }
    return result;
  }

  const SearchMethod& method = search_method(options.method);
  std::vector<TraverseCosts> costs;
  for (std::size_t i = 0; i < route.traverses.size() && options.traverse_search == nullptr; ++i)
    costs.push_back(costs_against(sampled, route.traverses[i], i, options, lengths[i], callback));
  if (options.fuse_traverses && costs.size() > 1) {
    std::vector<CostMatrix> joined = joined_traverses(route, costs, options, result.warnings);
    for (std::size_t i = 0; i < costs.size(); ++i) costs[i].enhanced = std::move(joined[i]);
  }
  std::size_t most_taken = 0;
  for (std::size_t i = 0; i < route.traverses.size(); ++i) {
    SearchOptions search = search_on_route(route.traverses[i], time_s, sampled, options);
    TraverseSearch::Found searched;
    if (options.traverse_search != nullptr) {
      searched = options.traverse_search->search(i, sampled, search);
    } else {
      searched.columns = std::move(costs[i].columns);
      search.gaps.reference = gaps_between(searched.columns, search.gaps.reference);
      searched.matches = search_surely(costs[i].enhanced, method, search);
    }
    const SureMatches& found = searched.matches;
    const std::size_t taken =
        take_surest(found.matches, route.traverses[i], searched.columns, lengths[i], options, result.matches);
    if (taken < most_taken) continue;
    most_taken = taken;
    result.probability_source = found.source;
    result.wrong_share = found.wrong_share;
    result.looked_at = found.looked_at;
  }
  if (method.name == "lines") {
    SequenceSearchOptions search = options.search;
    search.length = result.sequence_length;
    result.lines = static_cast<int>(search_lines(search).size());
  }
  return result;
}

}  // namespace place
