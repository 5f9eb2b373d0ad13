#pragma once

#include "place/match/search_graph.hpp"
#include "place/match/search_lines.hpp"
#include "place/match/search_path.hpp"
#include "place/match/walk_gaps.hpp"

namespace place {

/// What every search method gets besides the costs; each uses what applies to it.
struct SearchOptions {
  SequenceSearchOptions sequence;
  GraphSearchOptions graph;
  PathSearchOptions path;
  WalkGaps gaps;
};

}  // namespace place
