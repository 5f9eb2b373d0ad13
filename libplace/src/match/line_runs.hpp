#pragma once

#include "place/match/search_lines.hpp"

#include <cstddef>
#include <vector>

namespace place {

/// A stretch of a line along which the reference advances by the same step with every query.
struct LineRun {
  std::size_t ring;  ///< which of `SearchRuns::steps`
  int first_query, first_reference;
  int last_query, last_reference;  ///< offsets from the pair, inclusive
};

/// The lines of a search, cut into runs.
struct SearchRuns {
  std::vector<int> steps;                   ///< all steps of the runs, increasing
  std::vector<LineRun> runs;                ///< of all lines, one after another
  std::vector<std::uint32_t> counts;        ///< runs of each line
  int lowest_query = 0, highest_query = 0;  ///< offsets over all runs
  int lowest_reference = 0, highest_reference = 0;
};

/// Cuts every line into the fewest runs with one step each. Terms that lie outside the matrix for every pair
/// of `queries` by `references` keyframes are left out.
SearchRuns line_runs(const std::vector<SearchLine>& lines, std::size_t queries, std::size_t references);

}  // namespace place
