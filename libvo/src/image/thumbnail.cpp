#include "vo/image/thumbnail.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

/// What a pixel counts for in a cell.
struct Overlap {
  std::size_t pixel;
  std::uint32_t length;
};

/// Cells over the pixels along one axis. Lengths are in the largest unit of which both have a whole number.
struct Axis {
  std::uint32_t cell_length;
  std::vector<Overlap> overlaps;    ///< of one cell after another
  std::vector<std::size_t> begins;  ///< of each cell in them, and their end

  Axis(int cells, int pixels) {
    const int unit = std::gcd(cells, pixels);
    const std::int64_t pixel_length = cells / unit;
    cell_length = static_cast<std::uint32_t>(pixels / unit);
    for (int cell = 0; cell < cells; ++cell) {
      begins.push_back(overlaps.size());
      const std::int64_t begin = std::int64_t{cell} * cell_length, end = begin + cell_length;
      for (std::int64_t pixel = begin / pixel_length; pixel * pixel_length < end; ++pixel) {
        const std::int64_t length =
            std::min(end, (pixel + 1) * pixel_length) - std::max(begin, pixel * pixel_length);
        overlaps.push_back({static_cast<std::size_t>(pixel), static_cast<std::uint32_t>(length)});
      }
    }
    begins.push_back(overlaps.size());
  }

  [[nodiscard]] std::size_t cells() const { return begins.size() - 1; }
  [[nodiscard]] std::span<const Overlap> of(std::size_t cell) const {
    return std::span(overlaps).subspan(begins[cell], begins[cell + 1] - begins[cell]);
  }
};

/// `RowSum` holds 255 times a cell's height, `CellSum` 256 times its area.
template <typename RowSum, typename CellSum>
void average_cells(const cv::Mat& grey, const Axis& down, const Axis& across, std::span<std::uint8_t> out) {
  const CellSum area = static_cast<CellSum>(down.cell_length) * across.cell_length;
  std::vector<RowSum> column_sums(static_cast<std::size_t>(grey.cols));
  std::size_t k = 0;
  for (std::size_t y = 0; y < down.cells(); ++y) {
    // Rows first, whole rows at a time: what the compiler vectorises.
    std::ranges::fill(column_sums, RowSum{0});
    for (const Overlap& row : down.of(y)) {
      const std::uint8_t* const pixels = grey.ptr(static_cast<int>(row.pixel));
      const auto weight = static_cast<RowSum>(row.length);
      for (std::size_t x = 0; x < column_sums.size(); ++x)
        column_sums[x] = static_cast<RowSum>(column_sums[x] + weight * pixels[x]);
    }
    for (std::size_t x = 0; x < across.cells(); ++x) {
      CellSum sum = area / 2;
      for (const Overlap& column : across.of(x))
        sum += static_cast<CellSum>(column.length) * column_sums[column.pixel];
      out[k++] = static_cast<std::uint8_t>(sum / area);
    }
  }
}

}  // namespace

void make_thumbnail(const cv::Mat& image, const ThumbnailOptions& options, std::span<std::uint8_t> out) {
  if (image.empty() || image.depth() != CV_8U || (image.channels() != 1 && image.channels() != 3)) {
    throw std::invalid_argument("make_thumbnail: an 8-bit grey or BGR image expected");
  }
  if (options.width < 1 || options.height < 1 ||
      out.size() != static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height)) {
    throw std::invalid_argument("make_thumbnail: out must have width * height bytes");
  }
  cv::Mat grey = image;
  if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);

  const Axis down(options.height, grey.rows), across(options.width, grey.cols);
  constexpr std::uint64_t kWhite = 255;
  const std::uint64_t area = std::uint64_t{down.cell_length} * across.cell_length;
  const bool small = kWhite * down.cell_length <= std::numeric_limits<std::uint16_t>::max() &&
                     (kWhite + 1) * area <= std::numeric_limits<std::uint32_t>::max();
  if (small) {
    average_cells<std::uint16_t, std::uint32_t>(grey, down, across, out);
  } else {
    average_cells<std::uint32_t, std::uint64_t>(grey, down, across, out);
  }
}

}  // namespace vo
