#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace place {

/// A grid of cells over a picture, and the number of directions in each.
struct CellGrid {
  int rows = 16;
  int columns = 32;
  int cell_px = 4;     ///< side of a cell; the picture is resized to rows * cell_px by columns * cell_px
  int directions = 8;  ///< over 360 degrees

  [[nodiscard]] constexpr std::size_t values() const {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) *
           static_cast<std::size_t>(directions);
  }
};

/// Histograms of the direction of the grey gradient in cells of a picture, weighted by its magnitude
/// (Dalal and Triggs 2005, section 6.3, with its trilinear sharing).
///
/// Central differences, the border repeated; a pixel's magnitude is shared linearly between the two nearest
/// directions, and between the four nearest cells by its distance from their centres. All 360 degrees are
/// kept: whether a wall is lighter or darker than the sky characterises a place.
///
/// `frame`: 8 bit, grey or BGR, not empty. Returns grid.rows x grid.columns x grid.directions values >= 0,
/// the direction running fastest, in grey levels of difference over two pixels, summed over a cell. A uniform
/// picture gives all 0. Throws `std::invalid_argument` for another frame, or a grid without cells. Reads
/// every pixel of the frame once; apart from that 0.2 ms for a grid of 128 x 64 pixels.
std::vector<float> gradient_cells(const cv::Mat& frame, const CellGrid& grid = {});

/// Cells as bytes, to store them for every frame: square roots, which preserve small values, in 255 steps up
/// to the largest, which is stored first.
std::vector<std::uint8_t> pack_cells(std::span<const float> cells);

/// The inverse of `pack_cells`, up to its rounding. Throws `std::invalid_argument` for fewer than 4 bytes.
std::vector<float> unpack_cells(std::span<const std::uint8_t> packed);

/// The bytes that `pack_cells` gives for a grid.
constexpr std::size_t packed_size(const CellGrid& grid) {
  return sizeof(float) + grid.values();
}

}  // namespace place
