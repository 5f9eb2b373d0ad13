#include "vo/image/thumbnail.hpp"

#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace vo {

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
  cv::Mat thumbnail(options.height, options.width, CV_8UC1, out.data());
  cv::resize(grey, thumbnail, thumbnail.size(), 0, 0, cv::INTER_AREA);
}

}  // namespace vo
