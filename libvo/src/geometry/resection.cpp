#include "vo/geometry/resection.hpp"

#include "vo/geometry/bundle_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>

namespace vo {
namespace {

constexpr std::size_t kLeast = 4;

Resection refined(Bundle& bundle, const Pose3& start, const ResectionOptions& options) {
  bundle.poses = {start};
  adjust(bundle, {.noise = options.noise, .max_iterations = 15});
  Resection result{.camera = bundle.poses[0], .fits = {}};
  for (const double error : reprojection_errors(bundle)) {
    result.fits.push_back(error <= options.max_off * options.noise);
    if (result.fits.back()) ++result.inliers;
  }
  return result;
}

std::optional<Pose3> from_samples(const Bundle& bundle, const ResectionOptions& options) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> seen;
  for (const BundleObservation& observation : bundle.observations) {
    const cv::Vec3d& p = bundle.points[observation.point];
    points.emplace_back(p[0], p[1], p[2]);
    seen.emplace_back(observation.at.x, observation.at.y);
  }
  cv::UsacParams params;
  params.confidence = 0.999;
  params.maxIterations = 300;
  params.threshold = options.max_off * options.noise;
  params.randomGeneratorState = options.seed;
  params.sampler = cv::SAMPLING_UNIFORM;
  params.score = cv::SCORE_METHOD_MSAC;
  cv::Mat k = cv::Mat::eye(3, 3, CV_64F), turn, shift, inliers;
  if (!cv::solvePnPRansac(points, seen, k, cv::noArray(), turn, shift, inliers, params)) return std::nullopt;
  cv::Matx33d camera_from_world;
  cv::Rodrigues(turn, camera_from_world);
  const cv::Vec3d t(shift.at<double>(0), shift.at<double>(1), shift.at<double>(2));
  return Pose3{.rotation = camera_from_world.t(), .position = -(camera_from_world.t() * t)};
}

/// The position's part of the inverse of the points' information about the pose.
cv::Matx33d position_covariance(const Bundle& bundle, const Resection& result, double noise) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  const cv::Matx33d camera_from_world = result.camera.rotation.t();
  double squares = 0;
  for (std::size_t i = 0; i < bundle.observations.size(); ++i) {
    if (!result.fits[i]) continue;
    const cv::Vec3d offset = bundle.points[bundle.observations[i].point] - result.camera.position;
    const cv::Vec3d p = camera_from_world * offset;
    const double x = p[0] / p[2], y = p[1] / p[2];
    squares += std::pow(x - bundle.observations[i].at.x, 2) + std::pow(y - bundle.observations[i].at.y, 2);
    // Derivatives of x and y by a small turn and shift in the camera's axes.
    Vector6 by_x, by_y;
    by_x << x * y, -(1 + x * x), y, -1 / p[2], 0, x / p[2];
    by_y << 1 + y * y, -x * y, -x, 0, -1 / p[2], y / p[2];
    information += by_x * by_x.transpose() + by_y * by_y.transpose();
  }
  const double freedom = 2.0 * static_cast<double>(result.inliers) - 6;
  if (freedom <= 0) return cv::Matx33d::zeros();
  const Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> lu(information);
  if (!lu.isInvertible()) return cv::Matx33d::zeros();
  const double variance = std::max(squares / freedom, noise * noise / 16);
  const Eigen::Matrix<double, 6, 6> covariance = variance * lu.inverse();
  cv::Matx33d in_camera;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) in_camera(row, column) = covariance(3 + row, 3 + column);
  }
  return result.camera.rotation * in_camera * camera_from_world;
}

}  // namespace

Resection resection(std::span<const cv::Vec3d> points, std::span<const ImagePoint> seen, const Pose3& start,
                    const ResectionOptions& options) {
  if (points.size() != seen.size())
    throw std::invalid_argument("resection: one observation for each point expected");
  if (points.size() < kLeast) return {.camera = start, .fits = std::vector<bool>(points.size(), false)};
  Bundle bundle;
  bundle.points.assign(points.begin(), points.end());
  bundle.point_fixed.assign(points.size(), true);
  for (std::size_t i = 0; i < seen.size(); ++i) bundle.observations.push_back({0, i, seen[i]});

  Resection best = refined(bundle, start, options);
  if (static_cast<double>(best.inliers) < options.min_share * static_cast<double>(points.size())) {
    if (const std::optional<Pose3> sampled = from_samples(bundle, options)) {
      Resection other = refined(bundle, *sampled, options);
      if (other.inliers > best.inliers) best = std::move(other);
    }
  }
  best.position_covariance = position_covariance(bundle, best, options.noise);
  return best;
}

double displacement_sigma(const Resection& found, const cv::Vec3d& along) {
  const cv::Vec3d direction = cv::normalize(along);  // (0, 0, 0) stays so
  return std::sqrt(std::max(0.0, 2 * direction.dot(found.position_covariance * direction)));
}

}  // namespace vo
