#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace place {

/// Ranges beyond count as this: slope 185; at pi/4 a line would be vertical.
inline constexpr double kSteepestRangeRad = 0.78;

/// How the best line is held against the best one outside the uniqueness window.
enum class MatchScore {
  kDifference,  ///< of their costs, in standard deviations
  kRatio,       ///< 1 less that of their mean costs over the least of the matrix (SeqSLAM, OpenSeqSLAM)
};

/// Settings of `search_sequences`.
struct SequenceSearchOptions {
  int length = 10;  ///< query keyframes on a line (SeqSLAM's d_s)
  /// Slopes tan(pi/4 -+ this) are searched (SSS 5.1 varies it from 0 to 0.8; more than 0.78 counts as 0.78).
  double search_range_rad = 0.1;
  int slopes = 21;  ///< slopes across the range; those that give the same line are searched once
  std::optional<double>
      v_min;  ///< OpenSeqSLAM's form of the range: reference keyframes per query keyframe ...
  std::optional<double> v_max;  ///< ... in steps of 1 / length; both or neither, instead of the range above
  double min_fraction = 0.5;    ///< at an end, the share of a line that must lie inside the matrix
  int uniqueness_window = 10;   ///< reference keyframes on either side of a match that do not compete with it
  MatchScore score = MatchScore::kDifference;  ///< of whole lines only, if it is the ratio

  /// False, with a reason that names field, value and constraint, if a field is out of its range.
  bool is_valid(std::string* reason) const;
};

/// A straight line through a (query, reference) pair: `offsets[k]` is the distance of its reference from the
/// pair's at query offset k - length / 2; 0 at the pair itself.
struct SearchLine {
  double slope = 1;  ///< reference keyframes per query keyframe
  std::vector<int> offsets;
};

/// The distinct lines of the search range, by increasing slope. Throws `std::invalid_argument` for options
/// that are not valid.
std::vector<SearchLine> search_lines(const SequenceSearchOptions& options);

/// The largest distance of the lines from their pair, in references.
std::size_t reach_of(const std::vector<SearchLine>& lines);

}  // namespace place
