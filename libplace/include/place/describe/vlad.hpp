#pragma once

#include "place/describe/float_rows.hpp"

#include <cstddef>

namespace place {

/// The positions of local descriptors in a picture, and its division for VLAD.
struct VladGrid {
  int down = 11, across = 27;             ///< positions of the descriptors, evenly spaced, row after row
  double margin_y = 2.5, margin_x = 2.5;  ///< from the picture's border to the outermost, in their spacing
  int rows = 1, columns = 8;              ///< parts of the picture
};

/// VLAD (Jegou et al. 2010; Arandjelovic and Zisserman 2013) of each column of a picture: for every word the
/// sum of the residuals of its nearest descriptors, divided by its length, then each value's signed square
/// root, then the whole column divided by its length. A descriptor counts for the two nearest columns (and
/// rows), linearly by its distance from their middles, so that nothing jumps as a view moves.
///
/// `descriptors`: of one picture, down * across of them. Returns `columns` rows of rows * words * width
/// values; a column without any residual is all 0. Throws `std::invalid_argument` if sizes differ.
/// O(descriptors * words * width).
FloatRows vlad_columns(const FloatRows& descriptors, const FloatRows& words, const VladGrid& grid = {});

}  // namespace place
