#include "vo/geometry/bundle_adjustment.hpp"

#include <algorithm>
#include <array>
#include <ceres/ceres.h>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <stdexcept>

#include <Eigen/Geometry>
#include <opencv2/core/eigen.hpp>

namespace vo {
namespace {

/// Ambient: the quaternion world_from_camera (x y z w) and the position. Tangent: a turn in the camera's
/// axes, and the shift. Costs give their derivatives by the tangent in the first six columns, so the Jacobian
/// of plus selects those six.
class PoseManifold final : public ceres::Manifold {
 public:
  static constexpr int kAmbient = 7, kTangent = 6;
  [[nodiscard]] int AmbientSize() const override { return kAmbient; }
  [[nodiscard]] int TangentSize() const override { return kTangent; }
  bool Plus(const double* x, const double* delta, double* sum) const override {
    const Eigen::Map<const Eigen::Quaterniond> q(x);
    const Eigen::Map<const Eigen::Vector3d> turn(delta);
    const double angle_rad = turn.norm();
    const Eigen::Vector3d axis = angle_rad > 0 ? Eigen::Vector3d(turn / angle_rad) : Eigen::Vector3d::UnitX();
    Eigen::Map<Eigen::Quaterniond> result(sum);
    result = (q * Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis))).normalized();
    for (int i = 0; i < 3; ++i) sum[4 + i] = x[4 + i] + delta[3 + i];
    return true;
  }
  bool PlusJacobian(const double* /*x*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, kAmbient, kTangent, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* delta) const override {
    const Eigen::Map<const Eigen::Quaterniond> to(y), from(x);
    const Eigen::AngleAxisd turn(from.conjugate() * to);
    Eigen::Map<Eigen::Vector3d>(delta, 3) = turn.angle() * turn.axis();
    for (int i = 0; i < 3; ++i) delta[3 + i] = y[4 + i] - x[4 + i];
    return true;
  }
  bool MinusJacobian(const double* /*x*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, kTangent, kAmbient, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
};

constexpr double kLeastDepth = 1e-6;

class Reprojection final : public ceres::SizedCostFunction<2, PoseManifold::kAmbient, 3, 1> {
 public:
  Reprojection(const ImagePoint& at, double noise) : at_(at), scale_(1 / noise) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const Eigen::Quaterniond> q(parameters[0]);
    const Eigen::Map<const Eigen::Vector3d> position(parameters[0] + 4), point(parameters[1]);
    const Eigen::Matrix3d camera_from_world = q.conjugate().toRotationMatrix();
    const Eigen::Vector3d p = camera_from_world * (point - position);
    if (p.z() < kLeastDepth) return false;  // the step is taken back
    const double x = p.x() / p.z(), y = p.y() / p.z();
    const double radial = parameters[2][0], r2 = x * x + y * y, stretch = 1 + radial * r2;
    residuals[0] = (stretch * x - at_.x) * scale_;
    residuals[1] = (stretch * y - at_.y) * scale_;
    if (jacobians == nullptr) return true;
    Eigen::Matrix<double, 2, 3> by_p;
    by_p << 1, 0, -x, 0, 1, -y;
    Eigen::Matrix2d by_plane;
    by_plane << stretch + 2 * radial * x * x, 2 * radial * x * y, 2 * radial * x * y,
        stretch + 2 * radial * y * y;
    by_p = by_plane * by_p * (scale_ / p.z());
    const Eigen::Matrix<double, 2, 3> by_point = by_p * camera_from_world;
    if (jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 2, PoseManifold::kAmbient, Eigen::RowMajor>> j(jacobians[0]);
      // A turn w in the camera's axes moves p by p x w.
      Eigen::Matrix3d cross;
      cross << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0;
      j.leftCols<3>() = by_p * cross;
      j.middleCols<3>(3) = -by_point;
      j.col(6).setZero();
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>> j(jacobians[1]);
      j = by_point;
    }
    if (jacobians[2] != nullptr) {
      jacobians[2][0] = r2 * x * scale_;
      jacobians[2][1] = r2 * y * scale_;
    }
    return true;
  }

 private:
  ImagePoint at_;
  double scale_;
};

/// Prior knowledge of the radial distortion.
class RadialPrior final : public ceres::SizedCostFunction<1, 1> {
 public:
  RadialPrior(double mean, double sigma) : mean_(mean), sigma_(sigma) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = (parameters[0][0] - mean_) / sigma_;
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = 1 / sigma_;
    return true;
  }

 private:
  double mean_, sigma_;
};

using PoseBlock = std::array<double, PoseManifold::kAmbient>;

PoseBlock block_of(const Pose3& pose) {
  Eigen::Matrix3d rotation;
  cv::cv2eigen(pose.rotation, rotation);
  const Eigen::Quaterniond q(rotation);
  return {q.x(), q.y(), q.z(), q.w(), pose.position[0], pose.position[1], pose.position[2]};
}

Pose3 pose_of(const PoseBlock& block) {
  Pose3 pose{.position = {block[4], block[5], block[6]}};
  const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Quaterniond>(block.data()).toRotationMatrix();
  cv::eigen2cv(rotation, pose.rotation);
  return pose;
}

bool in_front(const Bundle& bundle, const BundleObservation& observation) {
  const Pose3& pose = bundle.poses[observation.pose];
  return (pose.rotation.t() * (bundle.points[observation.point] - pose.position))[2] > kLeastDepth;
}

void check(const Bundle& bundle) {
  const auto of_size = [](const std::vector<bool>& flags, std::size_t count) {
    return flags.empty() || flags.size() == count;
  };
  if (!of_size(bundle.pose_fixed, bundle.poses.size()) || !of_size(bundle.point_fixed, bundle.points.size()))
    throw std::invalid_argument("adjust: one flag for each pose and point expected");
  for (const BundleObservation& observation : bundle.observations) {
    if (observation.pose >= bundle.poses.size() || observation.point >= bundle.points.size())
      throw std::invalid_argument("adjust: observation of a pose or point that is not there");
  }
}

}  // namespace

bool adjust(Bundle& bundle, const BundleOptions& options) {
  check(bundle);
  std::vector<PoseBlock> poses;
  for (const Pose3& pose : bundle.poses) poses.push_back(block_of(pose));
  std::vector<cv::Vec3d> points = bundle.points;
  double radial = bundle.radial;

  PoseManifold manifold;
  ceres::CauchyLoss loss(2);
  ceres::Problem::Options owned_by_us;
  owned_by_us.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  owned_by_us.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  owned_by_us.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  owned_by_us.disable_all_safety_checks = true;
  std::deque<Reprojection> costs;  // declared before the problem that points to them
  RadialPrior prior(options.radial_mean, options.radial_sigma);
  ceres::Problem problem(owned_by_us);
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  std::vector<bool> pose_used(poses.size()), point_used(points.size());
  for (const BundleObservation& observation : bundle.observations) {
    const bool fixed_pose = !bundle.pose_fixed.empty() && bundle.pose_fixed[observation.pose];
    const bool fixed_point = !bundle.point_fixed.empty() && bundle.point_fixed[observation.point];
    if ((fixed_pose && fixed_point) || !in_front(bundle, observation)) continue;
    costs.emplace_back(observation.at, options.noise);
    double* const pose = poses[observation.pose].data();
    double* const point = points[observation.point].val;
    problem.AddResidualBlock(&costs.back(), &loss, pose, point, &radial);
    if (!pose_used[observation.pose]) {
      problem.SetManifold(pose, &manifold);
      if (fixed_pose) problem.SetParameterBlockConstant(pose);
      ordering->AddElementToGroup(pose, 1);
      pose_used[observation.pose] = true;
    }
    if (!point_used[observation.point]) {
      if (fixed_point) problem.SetParameterBlockConstant(point);
      ordering->AddElementToGroup(point, 0);
      point_used[observation.point] = true;
    }
  }
  if (costs.empty()) return true;
  ordering->AddElementToGroup(&radial, 1);
  if (options.radial_sigma > 0)
    problem.AddResidualBlock(&prior, nullptr, &radial);
  else
    problem.SetParameterBlockConstant(&radial);

  ceres::Solver::Options solver;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 1e-4;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  const bool points_fixed =
      !bundle.point_fixed.empty() && std::ranges::find(bundle.point_fixed, false) == bundle.point_fixed.end();
  solver.linear_solver_type = points_fixed ? ceres::DENSE_QR : ceres::DENSE_SCHUR;
  if (!points_fixed) solver.linear_solver_ordering = ordering;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (!summary.IsSolutionUsable()) return false;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (pose_used[i]) bundle.poses[i] = pose_of(poses[i]);
  }
  bundle.points = points;
  bundle.radial = radial;
  return true;
}

std::vector<double> reprojection_errors(const Bundle& bundle) {
  std::vector<double> errors;
  errors.reserve(bundle.observations.size());
  for (const BundleObservation& observation : bundle.observations) {
    const Pose3& pose = bundle.poses.at(observation.pose);
    const cv::Vec3d p = pose.rotation.t() * (bundle.points.at(observation.point) - pose.position);
    if (p[2] <= kLeastDepth) {
      errors.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    const ImagePoint at = with_radial({p[0] / p[2], p[1] / p[2]}, bundle.radial);
    errors.push_back(std::hypot(at.x - observation.at.x, at.y - observation.at.y));
  }
  return errors;
}

}  // namespace vo
