#include "vo/surf/integral_image.hpp"

#include "kernels/kernels.hpp"

#include <stdexcept>

namespace vo {
namespace {

IntegralImage make_integral_image(int width, int height) {
  IntegralImage integral{.width = width, .height = height, .stride = width + 1 + kernels::kLanes};
  integral.sums.resize(static_cast<std::size_t>(integral.stride) * static_cast<std::size_t>(height + 1) +
                       kernels::kLanes);
  return integral;
}

}  // namespace

IntegralImage integral_image(const cv::Mat& grey) {
  if (grey.type() != CV_8UC1 || grey.dims > 2)
    throw std::invalid_argument("integral_image: an 8-bit image of one channel expected");
  if (grey.total() > IntegralImage::kMaxPixels)
    throw std::invalid_argument("integral_image: at most 2^24 pixels expected");
  IntegralImage integral = make_integral_image(grey.cols, grey.rows);
  for (int y = 0; y < grey.rows; ++y) {
    const std::uint8_t* pixels = grey.ptr<std::uint8_t>(y);
    const std::uint32_t* above = integral.row(y);
    std::uint32_t* sums = integral.sums.data() + (y + 1) * integral.stride;
    std::uint32_t line = 0;
    for (int x = 0; x < grey.cols; ++x) {
      line += pixels[x];
      sums[x + 1] = above[x + 1] + line;
    }
  }
  return integral;
}

IntegralImage coarser(const IntegralImage& integral, int factor) {
  if (factor < 1) throw std::invalid_argument("coarser: factor must be at least 1");
  IntegralImage result = make_integral_image(integral.width / factor, integral.height / factor);
  for (int y = 0; y <= result.height; ++y) {
    const std::uint32_t* from = integral.row(y * factor);
    std::uint32_t* to = result.sums.data() + y * result.stride;
    for (int x = 0; x <= result.width; ++x) to[x] = from[x * factor];
  }
  return result;
}

}  // namespace vo
