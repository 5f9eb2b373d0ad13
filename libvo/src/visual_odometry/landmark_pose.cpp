#include "vo/visual_odometry/landmark_pose.hpp"

#include "vo/visual_odometry/landmark_tracking.hpp"

#include <algorithm>
#include <vector>

namespace vo {
namespace {

/// The number of cells of a coarse grid over the picture that contain points.
std::size_t cells_of(const std::vector<cv::Point2f>& points, cv::Size picture) {
  constexpr int kColumns = 6, kRows = 4;
  std::vector<bool> taken(kColumns * kRows);
  for (const cv::Point2f& point : points) {
    const int column = std::clamp(static_cast<int>(point.x) * kColumns / picture.width, 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(point.y) * kRows / picture.height, 0, kRows - 1);
    taken[static_cast<std::size_t>(row * kColumns + column)] = true;
  }
  return static_cast<std::size_t>(std::ranges::count(taken, true));
}

}  // namespace

LandmarkPose pose_by_landmarks(LandmarkMap& map, const Pose3& predicted, cv::Size picture,
                               const LandmarkPoseOptions& options) {
  std::vector<Landmark*> landmarks;
  std::vector<cv::Vec3d> points;
  std::vector<ImagePoint> seen;
  for (Landmark& landmark : map.landmarks) {
    if (!landmark.followed || !landmark.position) continue;
    landmarks.push_back(&landmark);
    points.push_back(*landmark.position);
    seen.push_back(landmark.at);
  }
  LandmarkPose pose{.landmarks = landmarks.size(), .found = {}};
  if (followed_landmarks(map) < options.min_points) {
    pose.loss = TrackLoss::kTooFewCorners;
    return pose;
  }
  pose.found = resection(points, seen, predicted, {.noise = options.noise, .seed = options.seed});
  if (pose.found.inliers < options.min_landmarks ||
      static_cast<double>(pose.found.inliers) <
          options.min_inlier_share * static_cast<double>(points.size())) {
    pose.loss = TrackLoss::kTooFewInliers;
    return pose;
  }
  std::vector<cv::Point2f> fitting;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    landmarks[i]->followed = pose.found.fits[i];
    if (pose.found.fits[i]) fitting.push_back(landmarks[i]->pixel);
  }
  if (cells_of(fitting, picture) < options.min_cells) pose.loss = TrackLoss::kPoorSpread;
  return pose;
}

}  // namespace vo
