#pragma once

#include "truth_options.hpp"

#include <string>
#include <vector>

namespace retrace {

/// A data set of a benchmark: two walks and the truth about them.
struct WalkPairEntry {
  std::string name;
  std::vector<std::string> query;      ///< files that are one walk
  std::vector<std::string> reference;  ///< the same
  TruthOptions truth;
};

/// Reads a list of pairs: a section for each, by its name, with `query` and `reference` (a file, a folder, or
/// a list of files in order), the truth (`pairs`, or `query-truth` and `reference-truth`), and `tolerance-m`
/// or `tolerance-frames`. Relative files are beside the list. Throws `vo::Error` naming file and section for
/// anything else: an unknown key, one repeated further down, a missing one, a name that is no folder's, no
/// pair at all. Two lines of `query` or of `reference` in succession are one list.
std::vector<WalkPairEntry> read_walk_pairs(const std::string& file);

}  // namespace retrace
