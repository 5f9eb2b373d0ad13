#include "place/describe/gradient_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include <vo/image/thumbnail.hpp>

namespace place {
namespace {

/// The two cells along one axis that a pixel counts for, and the share of the second.
struct Shares {
  std::vector<int> first;  // -1 before the first cell
  std::vector<float> second;
};

Shares shares_of(int cells, int cell_px) {
  Shares shares;
  for (int pixel = 0; pixel < cells * cell_px; ++pixel) {
    const float at = (static_cast<float>(pixel) + 0.5F) / static_cast<float>(cell_px) - 0.5F;
    const float low = std::floor(at);
    shares.first.push_back(static_cast<int>(low));
    shares.second.push_back(at - low);
  }
  return shares;
}

/// The picture in the grid's size, with a border of one pixel that repeats the outermost.
std::vector<std::uint8_t> bordered(const cv::Mat& frame, int width, int height) {
  std::vector<std::uint8_t> small(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  cv::Mat larger = frame;
  if (!frame.empty() && frame.depth() == CV_8U && frame.cols <= width)  // area averaging would produce steps
    cv::resize(frame, larger, {width, height}, 0, 0, cv::INTER_LINEAR);
  vo::make_thumbnail(larger, {.width = width, .height = height}, small);
  const std::size_t stride = static_cast<std::size_t>(width) + 2;
  std::vector<std::uint8_t> out(stride * (static_cast<std::size_t>(height) + 2));
  for (int y = -1; y <= height; ++y) {
    const std::uint8_t* row =
        small.data() + static_cast<std::ptrdiff_t>(std::clamp(y, 0, height - 1)) * width;
    std::uint8_t* to = out.data() + static_cast<std::size_t>(y + 1) * stride;
    to[0] = row[0];
    std::copy_n(row, width, to + 1);
    to[width + 1] = row[width - 1];
  }
  return out;
}

/// The angle of (dx, dy) in turns, 0 to 1, within 1e-5 of a turn: the arctangent's polynomial of Abramowitz
/// and Stegun 4.4.49, in arithmetic that compilers vectorise and that is the same everywhere.
float turns(float dx, float dy) {
  const float ax = std::abs(dx), ay = std::abs(dy);
  const float small = std::min(ax, ay), large = std::max(ax, ay);
  const float r = small / (large > 0 ? large : 1), s = r * r;
  float angle = r * (0.9998660F + s * (-0.3302995F + s * (0.1801410F + s * (-0.0851330F + s * 0.0208351F))));
  angle *= static_cast<float>(0.5 / std::numbers::pi);
  angle = ay > ax ? 0.25F - angle : angle;
  angle = dx < 0 ? 0.5F - angle : angle;
  return dy < 0 ? 1 - angle : angle;
}

}  // namespace

std::vector<float> gradient_cells(const cv::Mat& frame, const CellGrid& grid) {
  if (grid.rows < 1 || grid.columns < 1 || grid.cell_px < 1 || grid.directions < 2)
    throw std::invalid_argument("gradient_cells: rows, columns, cell_px >= 1 and directions >= 2 expected");
  const int width = grid.columns * grid.cell_px, height = grid.rows * grid.cell_px;
  const std::vector<std::uint8_t> image = bordered(frame, width, height);
  const Shares across = shares_of(grid.columns, grid.cell_px), down = shares_of(grid.rows, grid.cell_px);
  const auto directions = static_cast<std::size_t>(grid.directions);
  // One extra cell on every side receives what falls outside.
  const std::size_t cell_stride = directions,
                    row_stride = (static_cast<std::size_t>(grid.columns) + 2) * directions;
  std::vector<float> cells((static_cast<std::size_t>(grid.rows) + 2) * row_stride);
  const std::size_t stride = static_cast<std::size_t>(width) + 2;
  std::vector<float> magnitude(static_cast<std::size_t>(width)), second_share(magnitude.size());
  std::vector<int> first(magnitude.size());  // of the two nearest directions
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* row = image.data() + static_cast<std::size_t>(y + 1) * stride + 1;
    for (int x = 0; x < width; ++x) {
      const auto dx = static_cast<float>(row[x + 1] - row[x - 1]);
      const auto dy = static_cast<float>(row[x + static_cast<std::ptrdiff_t>(stride)] -
                                         row[x - static_cast<std::ptrdiff_t>(stride)]);
      magnitude[static_cast<std::size_t>(x)] = std::sqrt(dx * dx + dy * dy);
      const float at = turns(dx, dy) * static_cast<float>(grid.directions) - 0.5F;
      const int truncated = static_cast<int>(at);
      const int low = truncated - (at < static_cast<float>(truncated) ? 1 : 0);
      second_share[static_cast<std::size_t>(x)] = at - static_cast<float>(low);
      first[static_cast<std::size_t>(x)] = low < 0 ? low + grid.directions : low;
    }
    const float lower = down.second[static_cast<std::size_t>(y)];
    float* const upper_row =
        cells.data() + static_cast<std::size_t>(down.first[static_cast<std::size_t>(y)] + 1) * row_stride;
    for (std::size_t x = 0; x < magnitude.size(); ++x) {
      if (magnitude[x] == 0) continue;
      const auto one = static_cast<std::size_t>(first[x]);
      const std::size_t next = one + 1 == directions ? 0 : one + 1;
      const float share = second_share[x];
      float* const cell = upper_row + static_cast<std::size_t>(across.first[x] + 1) * cell_stride;
      const float right = across.second[x];
      const auto add = [&](float* histogram, float weight) {
        histogram[one] += weight * (1 - share);
        histogram[next] += weight * share;
      };
      add(cell, magnitude[x] * (1 - lower) * (1 - right));
      add(cell + cell_stride, magnitude[x] * (1 - lower) * right);
      add(cell + row_stride, magnitude[x] * lower * (1 - right));
      add(cell + row_stride + cell_stride, magnitude[x] * lower * right);
    }
  }
  std::vector<float> inner;
  inner.reserve(grid.values());
  for (std::size_t r = 0; r < static_cast<std::size_t>(grid.rows); ++r) {
    const float* row = cells.data() + (r + 1) * row_stride + cell_stride;
    inner.insert(inner.end(), row, row + static_cast<std::size_t>(grid.columns) * directions);
  }
  return inner;
}

std::vector<std::uint8_t> pack_cells(std::span<const float> cells) {
  const float largest = cells.empty() ? 0 : *std::ranges::max_element(cells);
  const float steps = largest > 0 ? 255 / std::sqrt(largest) : 0;
  std::vector<std::uint8_t> packed(sizeof(float) + cells.size());
  std::memcpy(packed.data(), &largest, sizeof(float));
  std::ranges::transform(cells, packed.begin() + sizeof(float), [&](float value) {
    return static_cast<std::uint8_t>(std::min(255.0F, steps * std::sqrt(value) + 0.5F));
  });
  return packed;
}

std::vector<float> unpack_cells(std::span<const std::uint8_t> packed) {
  if (packed.size() < sizeof(float)) throw std::invalid_argument("unpack_cells: packed cells expected");
  float largest = 0;
  std::memcpy(&largest, packed.data(), sizeof(float));
  packed = packed.subspan(sizeof(float));
  const float step = std::sqrt(largest) / 255;
  std::vector<float> cells(packed.size());
  std::ranges::transform(packed, cells.begin(), [&](std::uint8_t byte) {
    const float root = static_cast<float>(byte) * step;
    return root * root;
  });
  return cells;
}

}  // namespace place
