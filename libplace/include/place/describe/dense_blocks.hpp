#pragma once

#include "place/describe/float_rows.hpp"
#include "place/describe/gradient_cells.hpp"

#include <span>

namespace place {

inline constexpr int kBlockCells = 6;  ///< cells along a side of a block

/// Upright local descriptors all over a picture: blocks of 6 x 6 neighbouring cells at every position of the
/// grid, row after row.
///
/// Each is SIFT's (Lowe 2004, section 6.1) over more and smaller cells: values weighted by a Gaussian around
/// the block's middle (sigma 3 cells), divided by their length, clipped at 0.2, divided again, and, as in
/// RootSIFT (Arandjelovic and Zisserman 2012), L1-normalised and square-rooted. Not rotated to a main
/// direction: a walker's camera is upright, and direction distinguishes places. A block without texture stays
/// short instead of being amplified: 100 is added to its squared length, about that of noise of one grey
/// level.
///
/// `cells`: of `gradient_cells`, of that grid. Returns (rows - 5) x (columns - 5) rows of 36 * directions
/// values. Throws `std::invalid_argument` if the sizes differ or the grid is smaller than a block. O(values
/// out): 0.2 ms for 16 x 32 cells of 8 directions.
FloatRows dense_blocks(std::span<const float> cells, const CellGrid& grid = {});

}  // namespace place
