#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/search_lines.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace place {

/// The best line through one query keyframe.
struct SequenceMatch {
  std::optional<std::size_t> reference;  ///< keyframe; none if no line lies far enough inside the matrix
  double slope = 1;                      ///< of the best line
  float cost = 0;                        ///< of the best line
  float score = 0;  ///< uniqueness: how much more the best line elsewhere costs; higher is surer
  int terms = 0;    ///< keyframes of the best line inside the matrix; `length` except near the ends
};

/// SeqSLAM's search with straight lines (Milford and Wyeth 2012; SSS 3.4) around every query keyframe.
///
/// The cost of a line is the sum of its terms over sqrt(terms * length): the mean for a whole line. At the
/// ends of either walk only the part inside the matrix counts, scaled so that chance gives lines of every
/// length the same spread (enhanced costs have mean 0; with a plain mean, short lines would win by chance).
/// Lines with fewer than min_fraction * length terms are ignored. The score is the difference to the best
/// line outside the uniqueness window, or without one (a very short reference) to 0, the cost of an average
/// line. Throws `std::invalid_argument` for options that are not valid. Rounding, time and memory are those
/// of `SequenceSearcher`.
std::vector<SequenceMatch> search_sequences(const CostView& enhanced,
                                            const SequenceSearchOptions& options = {});

/// Turns scores that are differences into SeqSLAM's uniqueness: 1 - a / b of the mean costs a of the best
/// line and b of the best one outside the window, both over the least cost of the matrix, which the original
/// sets to 0; from 0 for no difference to 1. SeqSLAM's own is a / b, smaller where a match is surer.
/// `matches`: of whole lines, whose costs are means; `least`: as the lines' costs are counted, from the mean
/// of the matrix. O(n).
void score_by_ratio(std::vector<SequenceMatch>& matches, float least);

}  // namespace place
