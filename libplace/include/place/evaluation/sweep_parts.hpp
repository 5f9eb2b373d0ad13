#pragma once

#include "place/evaluation/sweep_grid.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace place {

/// One of several processes that divide a sweep among them.
struct SweepPart {
  std::size_t number = 1;  ///< from 1
  std::size_t of = 1;      ///< processes
};

/// Parses `I/N`, the part I of N. Throws `vo::Error` unless both are whole numbers and 1 <= I <= N.
SweepPart parse_part(const std::string& text);

/// Indices [begin, end) of `total` things that a part has; the parts differ by at most one.
struct PartRange {
  std::size_t begin = 0, end = 0;
};
PartRange range_of_part(const SweepPart& part, std::size_t total);

/// Every cell of a sweep once, in the order in which parts take them: cells for which walks are read alike
/// follow one another, and among these the cells that share a cost matrix, so that a part reads and compares
/// as little as possible.
std::vector<SweepCell> cells_by_work(const std::vector<SweepAxis>& axes);

}  // namespace place
