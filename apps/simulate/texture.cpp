#include "texture.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace simulate {

Texture::Texture(const cv::Mat& bgra) {
  if (bgra.empty() || bgra.type() != CV_8UC4) {
    throw std::invalid_argument("Texture: a non-empty CV_8UC4 image expected");
  }
  cv::Mat alpha;
  cv::extractChannel(bgra, alpha, 3);
  opaque_ = cv::countNonZero(alpha == 255) == static_cast<int>(alpha.total());

  cv::Mat image = bgra;
  for (;;) {
    const std::size_t stride = static_cast<std::size_t>(image.cols) + 1;
    layouts_.push_back({texels_.size(), image.cols, image.rows});
    texels_.resize(texels_.size() + stride * (static_cast<std::size_t>(image.rows) + 1));
    std::uint32_t* row = texels_.data() + layouts_.back().offset;
    for (int y = 0; y <= image.rows; ++y, row += stride) {
      std::memcpy(row, image.ptr(std::min(y, image.rows - 1)), (stride - 1) * sizeof(*row));
      row[stride - 1] = row[stride - 2];
    }
    if (image.cols == 1 && image.rows == 1) return;
    cv::Mat half;
    cv::resize(image, half, {(image.cols + 1) / 2, (image.rows + 1) / 2}, 0, 0, cv::INTER_AREA);
    image = half;
  }
}

}  // namespace simulate
