#include "vo/image/thumbnail.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

/// Calls `visit(pixel, weight)` for the pixels that cell `cell` of `cells` covers of `pixels` in a row. With
/// a pixel `cells` units long and a cell `pixels` units, every overlap is a whole number; together they weigh
/// `pixels`.
template <typename Visit>
void for_each_covered(int cell, int cells, int pixels, const Visit& visit) {
  const std::int64_t begin = std::int64_t{cell} * pixels;
  const std::int64_t end = begin + pixels;
  for (std::int64_t pixel = begin / cells; pixel * cells < end; ++pixel) {
    const std::int64_t overlap = std::min(end, (pixel + 1) * cells) - std::max(begin, pixel * cells);
    visit(static_cast<int>(pixel), static_cast<std::uint32_t>(overlap));
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

  // Rows first, whole rows at a time: what the compiler vectorises.
  const std::uint64_t area = static_cast<std::uint64_t>(grey.rows) * static_cast<std::uint64_t>(grey.cols);
  std::vector<std::uint32_t> column_sums(static_cast<std::size_t>(grey.cols));
  std::size_t k = 0;
  for (int y = 0; y < options.height; ++y) {
    std::ranges::fill(column_sums, 0U);
    for_each_covered(y, options.height, grey.rows, [&](int row, std::uint32_t weight) {
      const std::uint8_t* pixels = grey.ptr(row);
      for (std::size_t x = 0; x < column_sums.size(); ++x) column_sums[x] += weight * pixels[x];
    });
    for (int x = 0; x < options.width; ++x) {
      std::uint64_t sum = 0;
      for_each_covered(x, options.width, grey.cols, [&](int column, std::uint32_t weight) {
        sum += std::uint64_t{weight} * column_sums[static_cast<std::size_t>(column)];
      });
      out[k++] = static_cast<std::uint8_t>((sum + area / 2) / area);
    }
  }
}

}  // namespace vo
