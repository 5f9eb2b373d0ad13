#pragma once

#include <span>
#include <string>
#include <vector>

namespace place {

struct CostView;
struct SearchOptions;
struct SearchResult;
struct SequenceMatch;

/// Settings of `search_path`.
struct PathSearchOptions {
  /// For each query keyframe: the walk's own displacement since the one before, in reference keyframes, 0 or
  /// more. Empty: 1 each, as for two walks sampled at one spacing. The first is ignored.
  std::vector<double> steps;

  /// False, with a reason that names field, value and constraint, if a field is out of its range.
  bool is_valid(std::string* reason) const;
};

/// One path through the whole walk: a hidden Markov model whose states are the places of the reference and
/// one off the route. It follows Hansen and Browning 2014 ("Visual place recognition using HMM sequence
/// matching"), except for the off-route state and the transitions, which here come from the walk's own
/// displacement.
///
/// From one query to the next the place advances by s references with p(s) proportional to exp(-(s - step)^2
/// / (2 deviation^2)), s >= 0. The search range of `options.sequence` sets how much speeds may differ: the
/// step is the middle of the range (1, or that of v_min and v_max) times `PathSearchOptions::steps`; the
/// deviation is sqrt(max(1, step) (0.98^2 + h^2)), h half the range of slopes and at most 5: 1 for the
/// default range and an even walk. A walk leaves the route with probability 0.1 / length, and returns
/// anywhere with the same: a stretch along the route lasts ten sequences on average. A pair of cost c is
/// exp(-(c + 1) / 2) times as probable on the route as off it. This is even at one deviation below the mean
/// (the best of a few neighbours has that by chance), and half as steep as for independent normal costs,
/// since neighbouring pictures have similar errors. Costs beyond +-6 count as 6.
///
/// Forward and backward passes (Rabiner 1989) give the posterior of every place at every query, given the
/// whole walk. The match is where the posterior, smoothed by a triangle of +-4 references, is highest, as
/// neighbouring places share the probability of one place. Its score is log(inside / outside), the
/// posterior's mass up to `uniqueness_window` references from it over the mass elsewhere and off the route.
/// No step crosses a gap: the search restarts at a query's gap, and a reference's gap ends the route.
///
/// O(queries * references * probable steps); one thread for each stretch of the query. Memory: 12 bytes *
/// references * sqrt(queries). Throws `std::invalid_argument` for options that are not valid or unless there
/// is one step for each query.
SearchResult search_path(const CostView& enhanced, const SearchOptions& options);

/// How probable the path finds places that another search matched: the same matches with the score that
/// `search_path` would give their places, none where there is no match. Cost and errors as for it; throws
/// `std::invalid_argument` also unless there is one match on the reference for each query.
std::vector<SequenceMatch> path_scores(const CostView& enhanced, std::span<const SequenceMatch> matches,
                                       const SearchOptions& options);

}  // namespace place
