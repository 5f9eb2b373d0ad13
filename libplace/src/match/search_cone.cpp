#include "place/match/search_cone.hpp"

#include "match/cone_shape.hpp"
#include "match/row_minimum.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

/// References [begin, end) whose cones contain this many votes.
struct Votes {
  std::size_t begin, end;
  int count;
};

/// The runs of references with votes, in order: a query's single best match lies in the cones of a stretch of
/// references.
std::vector<Votes> votes_for(const ConeShape& shape, const std::vector<RowMinimum>& best, std::size_t query,
                             std::size_t references) {
  std::vector<std::pair<std::size_t, int>> turns;
  for (const ConeShape::Row& row : shape.rows()) {
    if (!shape.has_query(query, row)) continue;
    const RowMinimum& vote = best[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(query) + row.along)];
    if (vote.reference >= references) continue;
    const auto at = static_cast<std::ptrdiff_t>(vote.reference),
               last = static_cast<std::ptrdiff_t>(references);
    const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, at - row.high),
                         end = std::min(last, at - row.low + 1);
    if (begin >= end) continue;
    turns.emplace_back(begin, 1);
    turns.emplace_back(end, -1);
  }
  std::ranges::sort(turns);
  std::vector<Votes> runs;
  int count = 0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    count += turns[i].second;
    if (count > 0 && turns[i + 1].first > turns[i].first)
      runs.push_back({turns[i].first, turns[i + 1].first, count});
  }
  return runs;
}

SequenceMatch match_of(const ConeShape& shape, const std::vector<Votes>& runs, std::span<const float> own,
                       std::size_t query, std::size_t window) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto cost_at = [&](const Votes& run, std::size_t r) {
    const int terms = shape.terms(query, r);
    return shape.enough(terms) ? -static_cast<float>(run.count) * shape.factor(terms) : kInfinity;
  };
  SequenceMatch match{.cost = kInfinity};
  for (const Votes& run : runs) {
    for (std::size_t r = run.begin; r < run.end; ++r) {
      const float cost = cost_at(run, r);
      if (cost < match.cost || (cost < kInfinity && cost == match.cost && own[r] < own[*match.reference])) {
        match.reference = r;
        match.cost = cost;
        match.terms = shape.terms(query, r);
      }
    }
  }
  if (!match.reference) return {};
  float elsewhere = 0;
  for (const Votes& run : runs) {
    for (std::size_t r = run.begin; r < run.end; ++r) {
      const std::size_t apart = std::max(r, *match.reference) - std::min(r, *match.reference);
      if (apart > window) elsewhere = std::min(elsewhere, cost_at(run, r));
    }
  }
  match.score = elsewhere - match.cost;
  return match;
}

}  // namespace

std::vector<SequenceMatch> search_cone(const CostView& enhanced, const SequenceSearchOptions& options) {
  const ConeShape shape(options, enhanced.queries, enhanced.references);
  std::vector<RowMinimum> best(enhanced.queries);
  vo::parallel_for(enhanced.queries, [&](std::size_t q) { best[q] = row_minimum(enhanced.row(q)); });
  std::vector<SequenceMatch> matches(enhanced.queries);
  vo::parallel_for(enhanced.queries, [&](std::size_t q) {
    matches[q] = match_of(shape, votes_for(shape, best, q, enhanced.references), enhanced.row(q), q,
                          static_cast<std::size_t>(options.uniqueness_window));
  });
  return matches;
}

}  // namespace place
