#include "vo/visual_odometry/landmark_tracking.hpp"

#include "vo/geometry/triangulation.hpp"

#include <algorithm>

namespace vo {
namespace {

/// The image-plane points of pixels, without the distortion that the map has learned.
std::vector<ImagePoint> on_plane(const LandmarkMap& map, const Camera& camera,
                                 const std::vector<ImagePoint>& pixels) {
  std::vector<ImagePoint> points = undistort(camera, pixels);
  for (ImagePoint& point : points) point = without_radial(point, map.radial);
  return points;
}

}  // namespace

void add_corners(LandmarkMap& map, const cv::Mat& grey, const Camera& camera,
                 const CornerGridOptions& options) {
  std::vector<cv::Point2f> existing;
  for (const Landmark& landmark : map.landmarks) {
    if (landmark.followed) existing.push_back(landmark.pixel);
  }
  const std::vector<cv::Point2f> corners = grid_corners(grey, existing, options);
  std::vector<ImagePoint> pixels;
  for (const cv::Point2f& corner : corners) pixels.push_back({corner.x, corner.y});
  const std::vector<ImagePoint> at = on_plane(map, camera, pixels);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Landmark landmark{.pixel = corners[i], .at = at[i]};
    landmark.sightings.push_back({map.keyframes.size() - 1, at[i]});
    map.landmarks.push_back(std::move(landmark));
  }
}

void follow_landmarks(LandmarkMap& map, const KltPyramid& before, const KltPyramid& after,
                      const Camera& camera, const std::optional<Pose3>& predicted,
                      const KltOptions& options) {
  std::vector<Landmark*> landmarks;
  std::vector<cv::Point2f> from, guess;
  for (Landmark& landmark : map.landmarks) {
    if (!landmark.followed) continue;
    landmarks.push_back(&landmark);
    from.push_back(landmark.pixel);
    cv::Point2f flow = landmark.flow;
    if (predicted && landmark.position) {
      if (const std::optional<ImagePoint> at = project(*predicted, *landmark.position)) {
        flow = {static_cast<float>(camera.fx_px * (at->x - landmark.at.x)),
                static_cast<float>(camera.fy_px * (at->y - landmark.at.y))};
      }
    }
    guess.push_back(landmark.pixel + flow);
  }
  const auto found = follow(before, after, from, guess, options);
  std::vector<ImagePoint> pixels;
  for (const auto& at : found) pixels.push_back(at ? ImagePoint{at->x, at->y} : ImagePoint{});
  const std::vector<ImagePoint> at = on_plane(map, camera, pixels);
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    Landmark& landmark = *landmarks[i];
    landmark.followed = found[i].has_value();
    if (!landmark.followed) continue;
    landmark.flow = *found[i] - landmark.pixel;
    landmark.pixel = *found[i];
    landmark.at = at[i];
  }
}

std::size_t followed_landmarks(const LandmarkMap& map) {
  return static_cast<std::size_t>(std::ranges::count(map.landmarks, true, &Landmark::followed));
}

}  // namespace vo
