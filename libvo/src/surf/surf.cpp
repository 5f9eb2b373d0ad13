#include "vo/surf/surf.hpp"

#include "vo/base/parallel.hpp"
#include "vo/surf/descriptor.hpp"
#include "vo/surf/integral_image.hpp"
#include "vo/surf/orientation.hpp"
#include "vo/surf/smooth_pyramid.hpp"

#include <algorithm>

namespace vo {
namespace {

constexpr std::size_t kChunk = 32;  // points of one task

}  // namespace

Features detect_surf(const cv::Mat& grey, const SurfOptions& options) {
  Features features{.descriptor_size = options.extended ? 128U : 64U};
  features.points = detect_blobs(integral_image(grey), options.detector);
  if (features.points.empty()) return features;

  const float max_scale_px = std::ranges::max(features.points, {}, &Feature::scale_px).scale_px;
  const SmoothPyramid pyramid = smooth_pyramid(grey, 3 * max_scale_px);
  features.descriptors.resize(features.size() * features.descriptor_size);
  parallel_for((features.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min((chunk + 1) * kChunk, features.size());
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      Feature& point = features.points[i];
      if (!options.upright) point.orientation_rad = orientation(pyramid, point);
      describe(pyramid, point,
               {features.descriptors.data() + i * features.descriptor_size, features.descriptor_size});
    }
  });
  return features;
}

}  // namespace vo
