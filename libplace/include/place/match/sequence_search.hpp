#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/search_lines.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace place {

/// The best line through one query keyframe.
struct SequenceMatch {
  std::optional<std::size_t> reference;  ///< keyframe; none if no line has enough of itself inside the matrix
  double slope = 1;                      ///< of the best line
  float cost = 0;                        ///< of the best line
  float score = 0;  ///< uniqueness: how much dearer the best line elsewhere is; higher is surer
  int terms = 0;    ///< keyframes of the best line inside the matrix, `length` away from the ends
};

/// SeqSLAM's search with straight lines (Milford and Wyeth 2012; SSS 3.4) around every query keyframe.
///
/// The cost of a line is the sum of its terms over sqrt(terms * length): the mean for a whole line; at the
/// ends of either walk only the part inside the matrix counts, scaled so that chance alone gives lines of
/// every length the same spread (enhanced costs have mean 0; a plain mean would let short lines win by
/// chance). Lines with less than min_fraction * length terms are not looked at. The score is the difference
/// to the best line outside the uniqueness window; with no such line (a very short reference), to 0, the cost
/// of an average line. Throws `std::invalid_argument` for options that are not valid. By
/// `SequenceSearcher`, whose rounding, cost and memory these are.
std::vector<SequenceMatch> search_sequences(const CostMatrix& enhanced,
                                            const SequenceSearchOptions& options = {});

}  // namespace place
