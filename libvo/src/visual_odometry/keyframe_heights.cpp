#include "vo/visual_odometry/keyframe_heights.hpp"

#include <algorithm>

namespace vo {

cv::Vec3d direction_at(const LandmarkMap& map, std::size_t keyframe, double enough) {
  const cv::Vec3d& here = map.keyframes[keyframe].pose.position;
  cv::Vec3d longest{0, 0, 0};
  const auto goes_so_far = [&](const cv::Vec3d& travelled) {
    if (cv::norm(travelled) > cv::norm(longest)) longest = travelled;
    return cv::norm(longest) >= enough;
  };
  for (std::size_t i = keyframe + 1; i < map.keyframes.size(); ++i)
    if (goes_so_far(map.keyframes[i].pose.position - here)) return longest;
  for (std::size_t i = keyframe; i-- > 0;)
    if (goes_so_far(here - map.keyframes[i].pose.position)) return longest;
  return longest;
}

std::vector<double> keyframe_heights(const LandmarkMap& map, std::size_t keyframe, const cv::Vec3d& travelled,
                                     const GroundHeightOptions& options) {
  std::vector<cv::Vec3d> points;
  for (const Landmark& landmark : map.landmarks) {
    const bool sees =
        std::ranges::binary_search(landmark.sightings, keyframe, {}, &Landmark::Sighting::keyframe);
    if (landmark.position && sees) points.push_back(*landmark.position);
  }
  return heights_above(map.keyframes[keyframe].pose, travelled, points, options);
}

}  // namespace vo
