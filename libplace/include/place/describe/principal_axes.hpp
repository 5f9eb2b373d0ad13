#pragma once

#include "place/describe/float_rows.hpp"
#include "place/describe/row_products.hpp"

#include <cstddef>
#include <vector>

namespace place {

/// The directions of largest variance of vectors.
struct PrincipalAxes {
  std::vector<float> mean;
  FloatRows axes;  ///< unit vectors by decreasing variance; fewer than asked for if the vectors span fewer
};

/// Principal component analysis: the mean and the `count` axes of the largest variance.
///
/// From the products of all pairs of values or of all pairs of vectors, whichever are fewer, by subspace
/// iteration (Halko, Martinsson and Tropp 2011, algorithm 4.4) from a fixed start, so the same vectors give
/// the same axes. Axes of nearly equal variance mix; their span equals that of the exact ones to a few
/// thousandths. The sign of an axis makes its largest value positive. Throws `std::invalid_argument` without
/// vectors or for a count of 0. O(vectors * width * min(vectors, width)).
PrincipalAxes principal_axes(const FloatRows& vectors, std::size_t count);

/// Brings vectors to axes. The axes are arranged once, for any number of calls.
class Projection {
 public:
  explicit Projection(const PrincipalAxes& axes);

  /// The vectors minus `mean` (unless empty), along each axis; in parallel over the vectors. Throws
  /// `std::invalid_argument` for vectors of another length.
  FloatRows operator()(const FloatRows& vectors) const;

 private:
  RowPanels panels_;
  std::vector<float> offset_;  ///< the mean along each axis
};

/// The same, once.
FloatRows project(const FloatRows& vectors, const PrincipalAxes& axes);

}  // namespace place
