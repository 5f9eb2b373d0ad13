#include "match/line_runs.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

namespace place {
namespace {

constexpr int kLargestStep = 4;  // of a running sum; each step takes memory, and steeper lines are rare

/// One line's runs of one step; `ring` is the step itself.
std::vector<LineRun> runs_of_step(const SearchLine& line, int first, int last, int step) {
  const int half = static_cast<int>(line.offsets.size()) / 2;
  std::vector<LineRun> runs;
  for (int k = first; k < last; ++k) {
    const int reference = line.offsets[static_cast<std::size_t>(k)], query = k - half;
    if (!runs.empty() && reference - runs.back().last_reference == step) {
      runs.back().last_query = query;
      runs.back().last_reference = reference;
    } else {
      runs.push_back({static_cast<std::size_t>(step), query, reference, query, reference});
    }
  }
  return runs;
}

std::vector<LineRun> fewest_runs(const SearchLine& line, int queries, int references) {
  const int length = static_cast<int>(line.offsets.size()), half = length / 2;
  const auto inside = [&](int k) {
    return std::abs(k - half) < queries && std::abs(line.offsets[static_cast<std::size_t>(k)]) < references;
  };
  int first = half, last = half + 1;
  while (first > 0 && inside(first - 1)) --first;
  while (last < length && inside(last)) ++last;
  std::vector<LineRun> fewest;
  for (int step = 0; step <= kLargestStep; ++step) {
    std::vector<LineRun> runs = runs_of_step(line, first, last, step);
    if (fewest.empty() || runs.size() < fewest.size()) fewest = std::move(runs);
  }
  return fewest;
}

}  // namespace

SearchRuns line_runs(const std::vector<SearchLine>& lines, std::size_t queries, std::size_t references) {
  constexpr std::size_t kMost = 1U << 30U;
  SearchRuns result;
  std::set<int> steps;
  for (const SearchLine& line : lines) {
    const std::vector<LineRun> runs = fewest_runs(line, static_cast<int>(std::min(queries, kMost)),
                                                  static_cast<int>(std::min(references, kMost)));
    for (const LineRun& run : runs) {
      steps.insert(static_cast<int>(run.ring));
      result.lowest_query = std::min(result.lowest_query, run.first_query);
      result.highest_query = std::max(result.highest_query, run.last_query);
      result.lowest_reference = std::min(result.lowest_reference, run.first_reference);
      result.highest_reference = std::max(result.highest_reference, run.last_reference);
    }
    result.counts.push_back(static_cast<std::uint32_t>(runs.size()));
    result.runs.insert(result.runs.end(), runs.begin(), runs.end());
  }
  result.steps.assign(steps.begin(), steps.end());
  for (LineRun& run : result.runs) {
    run.ring = static_cast<std::size_t>(std::ranges::lower_bound(result.steps, static_cast<int>(run.ring)) -
                                        result.steps.begin());
  }
  return result;
}

}  // namespace place
