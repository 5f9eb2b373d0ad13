#pragma once

#include "place/describe/float_rows.hpp"

#include <cstddef>
#include <vector>

namespace place {

/// The directions in which vectors differ most.
struct PrincipalAxes {
  std::vector<float> mean;
  FloatRows axes;  ///< unit vectors, that of the largest variance first; fewer than asked for, where the
                   ///< vectors have no more of them
};

/// Principal component analysis: the mean and the `count` axes of the largest variance.
///
/// From the products of all pairs of values or of all pairs of vectors, whichever are fewer, by subspace
/// iteration (Halko, Martinsson and Tropp 2011, algorithm 4.4) from a fixed start, so the same vectors give
/// the same axes. Axes of variances that are nearly equal mix; what they span is that of the exact ones to
/// some thousandths. The sign of an axis is such that its largest value is positive. Throws
/// `std::invalid_argument` without vectors or for a count of 0. O(vectors * width * min(vectors, width)).
PrincipalAxes principal_axes(const FloatRows& vectors, std::size_t count);

/// The vectors less `mean` (where it is not empty), along each axis; in parallel over the vectors.
FloatRows project(const FloatRows& vectors, const PrincipalAxes& axes);

}  // namespace place
