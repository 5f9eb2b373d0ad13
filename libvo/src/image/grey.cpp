#include "vo/image/grey.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace vo {

cv::Mat grey_of(const cv::Mat& frame, int width_px) {
  cv::Mat grey = frame;
  if (frame.channels() == 3) cv::cvtColor(frame, grey, cv::COLOR_BGR2GRAY);
  if (grey.cols <= width_px) return grey;
  cv::Mat small;
  const int height_px = static_cast<int>(std::lround(static_cast<double>(grey.rows) * width_px / grey.cols));
  cv::resize(grey, small, {width_px, std::max(1, height_px)}, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace vo
