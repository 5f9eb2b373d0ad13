#include "vo/surf/smooth_pyramid.hpp"

#include "vo/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace vo {
namespace {

constexpr float kFirstScale = 1.6F;  // the least of level 0
constexpr int kTaskRows = 90;        // of one task; small levels are one task, which starts no threads

SmoothLevel make_level(int width, int height, int step_px) {
  // One column and row more, read with weight 0 by samples on the rim.
  SmoothLevel level{.width = width, .height = height, .stride = width + 1, .step_px = step_px};
  level.values.resize(static_cast<std::size_t>(level.stride) * static_cast<std::size_t>(height + 1) + 1);
  return level;
}

/// Calls row(y) for every row, by bands.
template <class Row>
void for_rows(int height, Row row) {
  parallel_for(static_cast<std::size_t>((height + kTaskRows - 1) / kTaskRows), [&](std::size_t band) {
    const int begin = static_cast<int>(band) * kTaskRows;
    row(begin, std::min(begin + kTaskRows, height));
  });
}

/// (1 2 1)/4 along both axes, times 16.
SmoothLevel first_level(const cv::Mat& grey) {
  SmoothLevel level = make_level(grey.cols, grey.rows, 1);
  for_rows(level.height, [&](int begin, int end) {
    std::vector<std::uint16_t> line(static_cast<std::size_t>(grey.cols) + 2);
    for (int y = begin; y < end; ++y) {
      const std::uint8_t* a = grey.ptr<std::uint8_t>(std::max(y - 1, 0));
      const std::uint8_t* b = grey.ptr<std::uint8_t>(y);
      const std::uint8_t* c = grey.ptr<std::uint8_t>(std::min(y + 1, grey.rows - 1));
      std::uint16_t* sum = line.data() + 1;
      for (int x = 0; x < grey.cols; ++x) sum[x] = static_cast<std::uint16_t>(a[x] + 2 * b[x] + c[x]);
      sum[-1] = sum[0];
      sum[grey.cols] = sum[grey.cols - 1];
      std::uint16_t* out = level.values.data() + y * level.stride;
      for (int x = 0; x < grey.cols; ++x)
        out[x] = static_cast<std::uint16_t>(sum[x - 1] + 2 * sum[x] + sum[x + 1]);
    }
  });
  return level;
}

/// (1 4 6 4 1)/16 along both axes.
SmoothLevel smoother(const SmoothLevel& from) {
  SmoothLevel level = make_level(from.width, from.height, from.step_px);
  const auto filter = [](int a, int b, int c, int d, int e) {
    return static_cast<std::uint16_t>((a + e + 4 * (b + d) + 6 * c + 8) >> 4);
  };
  for_rows(level.height, [&](int begin, int end) {
    std::vector<std::uint16_t> line(static_cast<std::size_t>(from.width) + 4);
    for (int y = begin; y < end; ++y) {
      const auto row = [&](int dy) {
        return from.values.data() + std::clamp(y + dy, 0, from.height - 1) * from.stride;
      };
      const std::uint16_t *a = row(-2), *b = row(-1), *c = row(0), *d = row(1), *e = row(2);
      std::uint16_t* mean = line.data() + 2;
      for (int x = 0; x < from.width; ++x) mean[x] = filter(a[x], b[x], c[x], d[x], e[x]);
      mean[-2] = mean[-1] = mean[0];
      mean[from.width] = mean[from.width + 1] = mean[from.width - 1];
      std::uint16_t* out = level.values.data() + y * level.stride;
      for (int x = 0; x < from.width; ++x)
        out[x] = filter(mean[x - 2], mean[x - 1], mean[x], mean[x + 1], mean[x + 2]);
    }
  });
  return level;
}

/// Every other row and column.
SmoothLevel shrunk(const SmoothLevel& from) {
  SmoothLevel level = make_level((from.width + 1) / 2, (from.height + 1) / 2, 2 * from.step_px);
  for (int y = 0; y < level.height; ++y) {
    const std::uint16_t* in = from.values.data() + 2 * y * from.stride;
    std::uint16_t* out = level.values.data() + y * level.stride;
    for (int x = 0; x < level.width; ++x) out[x] = in[2 * x];
  }
  return level;
}

/// How many half octaves a scale is above the first, rounded down.
int half_octaves(float scale_px) {
  int result = 0;
  for (float bound = kFirstScale * std::numbers::sqrt2_v<float>; scale_px >= bound && result < 30;
       bound *= std::numbers::sqrt2_v<float>)
    ++result;
  return result;
}

}  // namespace

const SmoothLevel& SmoothPyramid::level(float scale_px, int coarser) const {
  return levels[std::min(static_cast<std::size_t>(half_octaves(scale_px) + coarser), levels.size() - 1)];
}

SmoothPyramid smooth_pyramid(const cv::Mat& grey, float max_scale_px) {
  if (grey.empty() || grey.type() != CV_8UC1 || grey.dims > 2)
    throw std::invalid_argument("smooth_pyramid: an 8-bit image of one channel expected");
  SmoothPyramid pyramid;
  pyramid.levels.push_back(first_level(grey));
  const auto count = static_cast<std::size_t>(half_octaves(max_scale_px)) + 1;
  while (pyramid.levels.size() < count) {
    const SmoothLevel& last = pyramid.levels.back();
    if (pyramid.levels.size() % 2 == 1) {
      pyramid.levels.push_back(smoother(last));
    } else if (std::min(last.width, last.height) > 2) {
      pyramid.levels.push_back(shrunk(last));
    } else {
      break;
    }
  }
  return pyramid;
}

}  // namespace vo
