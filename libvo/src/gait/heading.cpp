#include "vo/gait/heading.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Dense>
#include <fmt/format.h>

namespace vo {
namespace {

/// The tracked points on the image plane.
struct Rays {
  std::vector<ImagePoint> from;
  std::vector<ImagePoint> to;
};

Rays rays_of(std::span<const TrackedPoint> points, const Camera& camera) {
  std::vector<ImagePoint> from, to;
  for (const TrackedPoint& point : points) {
    from.push_back({point.from.x_px, point.from.y_px});
    to.push_back({point.to.x_px, point.to.y_px});
  }
  return {undistort(camera, from), undistort(camera, to)};
}

double naive_turn(std::span<const TrackedPoint> points, const Camera& camera) {
  std::vector<double> shifts;
  for (const TrackedPoint& point : points) shifts.push_back(point.to.x_px - point.from.x_px);
  const double fov_rad = 2 * std::atan(camera.width_px / 2.0 / camera.fx_px);
  return -median(shifts) * fov_rad / camera.width_px;
}

double regions_turn(std::span<const TrackedPoint> points, const Rays& rays, const Camera& camera,
                    int strips) {
  std::vector<std::vector<double>> turns(static_cast<std::size_t>(strips));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double column = (points[i].to.x_px + 0.5) / camera.width_px;
    const auto strip = std::clamp(static_cast<int>(column * strips), 0, strips - 1);
    turns[static_cast<std::size_t>(strip)].push_back(std::atan(rays.from[i].x) - std::atan(rays.to[i].x));
  }
  std::vector<double> votes;
  for (const std::vector<double>& strip : turns) {
    constexpr std::size_t kVoters = 3;
    if (strip.size() >= kVoters) votes.push_back(median(strip));
  }
  return votes.empty() ? naive_turn(points, camera) : median(votes);
}

/// Rotation of small angles about x (right), y (down) and z (forward); exact to the third order in them.
Eigen::Matrix3d rotation(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// b ~ R a + t: turning the camera right by psi moves points by -psi about y.
double epipolar_turn(const Rays& rays, double start_turn_rad, double noise) {
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  constexpr int kIterations = 8;
  // One standard deviation of the direction of travel about the optical axis, and of the rotation about its
  // start.
  constexpr double kTravelPrior = 0.3, kTurnPrior_rad = 0.2;
  const std::size_t n = rays.from.size();
  Vector5 state;  // rotation vector, then the direction of travel's x and y at z = 1
  state << 0, -start_turn_rad, 0, 0, 0;
  const Vector5 prior_mean = state;
  Vector5 prior_weight;
  prior_weight << Eigen::Vector3d::Constant(1 / (kTurnPrior_rad * kTurnPrior_rad)),
      Eigen::Vector2d::Constant(1 / (kTravelPrior * kTravelPrior));

  const auto residual = [&](const Vector5& at, std::size_t i) {
    const Eigen::Vector3d a(rays.from[i].x, rays.from[i].y, 1), b(rays.to[i].x, rays.to[i].y, 1);
    const Eigen::Matrix3d e = cross_matrix({at[3], at[4], 1}) * rotation(at.head<3>());
    const Eigen::Vector3d ea = e * a, eb = e.transpose() * b;
    const double scale = std::sqrt(ea.head<2>().squaredNorm() + eb.head<2>().squaredNorm());
    return b.dot(ea) / std::max(scale, 1e-9);
  };
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix<double, 5, 5> normal = prior_weight.asDiagonal();
    Vector5 gradient = prior_weight.cwiseProduct(state - prior_mean);
    // E and its derivatives are the same for every point.
    const Eigen::Matrix3d t = cross_matrix({state[3], state[4], 1}), r = rotation(state.head<3>());
    const Eigen::Matrix3d e = t * r;
    std::array<Eigen::Matrix3d, 5> derivative;
    for (int k = 0; k < 3; ++k)
      derivative[static_cast<std::size_t>(k)] = t * cross_matrix(Eigen::Vector3d::Unit(k)) * r;
    for (int k = 0; k < 2; ++k)
      derivative[static_cast<std::size_t>(3 + k)] = cross_matrix(Eigen::Vector3d::Unit(k)) * r;
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector3d a(rays.from[i].x, rays.from[i].y, 1), b(rays.to[i].x, rays.to[i].y, 1);
      const Eigen::Vector3d ea = e * a, eb = e.transpose() * b;
      const double scale = std::sqrt(ea.head<2>().squaredNorm() + eb.head<2>().squaredNorm());
      if (scale < 1e-9) continue;
      const double error = b.dot(ea) / scale / noise;
      const double weight = 1 / (1 + error * error / 4);  // Cauchy, at two standard deviations
      Vector5 row;
      for (std::size_t k = 0; k < 5; ++k)
        row[static_cast<Eigen::Index>(k)] = b.dot(derivative[k] * a) / scale / noise;
      normal += weight * row * row.transpose();
      gradient += weight * error * row;
    }
    const Vector5 step = normal.ldlt().solve(gradient);
    // The rotation's derivative is taken at its left: exp(step) R.
    const Eigen::AngleAxisd turned(rotation(-step.head<3>()) * r);
    state.head<3>() = turned.angle() * turned.axis();
    state.tail<2>() -= step.tail<2>();
    if (step.norm() < 1e-7) break;
  }
  (void)residual;
  return -state[1];
}

}  // namespace

bool HeadingOptions::is_valid(std::string* error) const {
  if (strips < 1) return *error = fmt::format("strips is {}; expected at least 1", strips), false;
  if (min_points < 1) return *error = fmt::format("min_points is {}; expected at least 1", min_points), false;
  if (!(noise_px > 0)) return *error = fmt::format("noise_px is {}; expected > 0", noise_px), false;
  return true;
}

std::optional<double> turn(std::span<const TrackedPoint> points, const Camera& camera,
                           const HeadingOptions& options) {
  if (std::string error; !options.is_valid(&error)) throw std::invalid_argument("turn: " + error);
  if (points.size() < static_cast<std::size_t>(options.min_points)) return std::nullopt;
  if (options.method == HeadingMethod::kNaive) return naive_turn(points, camera);
  const Rays rays = rays_of(points, camera);
  const double regions = regions_turn(points, rays, camera, options.strips);
  if (options.method == HeadingMethod::kRegions) return regions;
  return epipolar_turn(rays, regions, options.noise_px / camera.fx_px);
}

}  // namespace vo
