#pragma once

#include <algorithm>
#include <cstddef>
#include <dlib/image_keypoint.h>

#include <opencv2/core.hpp>

#include <vo/surf/features.hpp>

namespace bench {

using DlibImage = dlib::array2d<unsigned char>;

inline DlibImage dlib_image(const cv::Mat& grey) {
  DlibImage image(grey.rows, grey.cols);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) image[y][x] = grey.at<unsigned char>(y, x);
  }
  return image;
}

/// The strongest points of dlib's SURF in our form, at most `max_points`. dlib cuts its list before it drops
/// the points near the rim, so the cut is made here.
inline vo::Features dlib_surf(const DlibImage& image, std::size_t max_points, double threshold) {
  const auto found = dlib::get_surf_points(image, 100000, threshold);
  vo::Features features{.descriptor_size = 64};
  for (std::size_t i = 0; i < std::min(max_points, found.size()); ++i) {
    const auto& point = found[i];
    features.points.push_back({.x_px = static_cast<float>(point.p.center.x()),
                               .y_px = static_cast<float>(point.p.center.y()),
                               .scale_px = static_cast<float>(point.p.scale),
                               .orientation_rad = static_cast<float>(point.angle),
                               .response = static_cast<float>(point.p.score),
                               .laplacian = static_cast<std::int8_t>(point.p.laplacian >= 0 ? 1 : -1)});
    for (long k = 0; k < 64; ++k) features.descriptors.push_back(static_cast<float>(point.des(k)));
  }
  return features;
}

}  // namespace bench
