#pragma once

#include "place/cost_matrix.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace place {

/// Settings of `search_sequences`.
struct SequenceSearchOptions {
  int length = 10;                ///< query keyframes on a line (SeqSLAM's d_s)
  double search_range_rad = 0.1;  ///< slopes tan(pi/4 -+ this) are searched (SSS 5.1 varies it from 0 to 0.8)
  int slopes = 21;                ///< slopes across the range; those that give one line are searched once
  std::optional<double>
      v_min;  ///< OpenSeqSLAM's form of the range: reference keyframes per query keyframe ...
  std::optional<double> v_max;  ///< ... in steps of 1 / length; both or neither, instead of the range above
  double min_fraction = 0.5;    ///< at an end, the part of a line that must lie inside the matrix
  int uniqueness_window = 10;   ///< reference keyframes on either side of a match that do not compete with it

  /// False, with a reason that names field, value and constraint, if a field is out of its range.
  bool is_valid(std::string* reason) const;
};

/// A straight line through a (query, reference) pair: `offsets[k]` is how far its reference lies from the
/// pair's at query offset k - length / 2; 0 at the pair itself.
struct SearchLine {
  double slope = 1;  ///< reference keyframes per query keyframe
  std::vector<int> offsets;
};

/// The distinct lines of the search range, by increasing slope.
std::vector<SearchLine> search_lines(const SequenceSearchOptions& options);

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
/// of an average line. Throws `std::invalid_argument` for options that are not valid. O(queries * references
/// * lines * length), in parallel over queries; O(references) memory for each thread.
std::vector<SequenceMatch> search_sequences(const CostMatrix& enhanced,
                                            const SequenceSearchOptions& options = {});

}  // namespace place
