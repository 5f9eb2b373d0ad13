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

Eigen::Matrix3d rotation(const Eigen::Vector3d& w) {
  const double angle_rad = w.norm();
  if (angle_rad < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle_rad, w / angle_rad).toRotationMatrix();
}

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// The essential matrix [t]x R of two views: three angles of R, and t's x and y at z = 1.
struct Epipolar {
  Eigen::Vector3d rotation;
  Eigen::Vector3d travel;
  Matrix5 information;  ///< of both, by the points alone
};

/// Gauss-Newton, starting from a turn and travel along the optical axis. `travel_sd`: standard deviation of t
/// to the side of that axis. A camera that turns right moves points by a rotation about y to the left.
Epipolar solve_epipolar(const Rays& rays, double start_turn_rad, double travel_sd, double noise) {
  constexpr int kMaxIterations = 10;
  constexpr double kConverged = 1e-7;
  // Far wider than what the points show, unless they show nothing.
  constexpr double kRotationSd_rad = 0.2, kTiltSd = 0.3;
  Vector5 prior;
  prior << Eigen::Vector3d::Constant(1 / (kRotationSd_rad * kRotationSd_rad)), 1 / (travel_sd * travel_sd),
      1 / (kTiltSd * kTiltSd);

  const Eigen::Vector3d start(0, -start_turn_rad, 0);
  Epipolar solution{.rotation = start, .travel = {0, 0, 1}, .information = Matrix5::Zero()};
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Eigen::Matrix3d r = rotation(solution.rotation);
    const Eigen::Vector3d& t = solution.travel;
    Vector5 gradient = Vector5::Zero();
    solution.information.setZero();
    for (std::size_t i = 0; i < rays.from.size(); ++i) {
      const Eigen::Vector3d b(rays.to[i].x, rays.to[i].y, 1);
      const Eigen::Vector3d turned = r * Eigen::Vector3d(rays.from[i].x, rays.from[i].y, 1);
      const Eigen::Vector3d plane = b.cross(t);  // b' [t]x R a = plane . R a
      const double length = std::sqrt(t.cross(turned).head<2>().squaredNorm() +
                                      (r.transpose() * plane).head<2>().squaredNorm());
      if (!(length > 0)) continue;  // at the point that the walker heads for
      const double scale = 1 / (length * noise);
      const double error = plane.dot(turned) * scale;     // Sampson's distance
      const double weight = 1 / (1 + error * error / 4);  // Cauchy's, at two standard deviations
      Vector5 row;
      row << turned.cross(plane), turned.cross(b).head<2>();
      row *= scale;
      solution.information.noalias() += weight * row * row.transpose();
      gradient += weight * error * row;
    }
    Vector5 off_prior;
    off_prior << solution.rotation - start, t.head<2>();
    const Matrix5 normal = solution.information + Matrix5(prior.asDiagonal());
    const Vector5 step = normal.ldlt().solve(gradient + prior.cwiseProduct(off_prior));
    const Eigen::AngleAxisd next(rotation(-step.head<3>()) * r);
    solution.rotation = next.angle() * next.axis();
    solution.travel.head<2>() -= step.tail<2>();
    if (step.norm() < kConverged) break;
  }
  return solution;
}

Turn epipolar_turn(const Rays& rays, double start_turn_rad, double noise) {
  constexpr double kAhead = 1e-3, kAnywhere = 0.3;
  constexpr Eigen::Index kTurn = 1, kSide = 3;
  const Epipolar ahead = solve_epipolar(rays, start_turn_rad, kAhead, noise);
  Turn turn{.turn_rad = -ahead.rotation.y(), .turn_per_travel = 0, .travel_rad = {}};

  // How the others change with a unit of travel to the side: their part of the information, solved for it.
  Eigen::Matrix4d others;
  Eigen::Vector4d coupling;
  constexpr std::array<Eigen::Index, 4> kOthers{0, 1, 2, 4};
  for (std::size_t i = 0; i < kOthers.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    coupling[row] = ahead.information(kOthers[i], kSide);
    for (std::size_t j = 0; j < kOthers.size(); ++j)
      others(row, static_cast<Eigen::Index>(j)) = ahead.information(kOthers[i], kOthers[j]);
  }
  others.diagonal().array() += 1;  // negligible next to what a few points show
  turn.turn_per_travel = others.ldlt().solve(coupling)[kTurn];

  // Root mean square motion of the points by travel to the side, in their standard deviations; where the
  // walker is still, noise looks like a few.
  constexpr double kParallax = 5;
  const Epipolar free = solve_epipolar(rays, start_turn_rad, kAnywhere, noise);
  const auto points = static_cast<double>(rays.from.size());
  if (free.information(kSide, kSide) > kParallax * kParallax * points) {
    turn.travel_rad = std::atan(free.travel.x());
  }
  return turn;
}

}  // namespace

bool HeadingOptions::is_valid(std::string* error) const {
  if (strips < 1) return *error = fmt::format("strips is {}; expected at least 1", strips), false;
  if (min_points < 1) return *error = fmt::format("min_points is {}; expected at least 1", min_points), false;
  if (!(noise_px > 0)) return *error = fmt::format("noise_px is {}; expected > 0", noise_px), false;
  return true;
}

std::optional<Turn> turn(std::span<const TrackedPoint> points, const Camera& camera,
                         const HeadingOptions& options) {
  if (std::string error; !options.is_valid(&error)) throw std::invalid_argument("turn: " + error);
  if (points.size() < static_cast<std::size_t>(options.min_points)) return std::nullopt;
  if (options.method == HeadingMethod::kNaive) return Turn{naive_turn(points, camera), 0, {}};
  const Rays rays = rays_of(points, camera);
  const double regions = regions_turn(points, rays, camera, options.strips);
  if (options.method == HeadingMethod::kRegions) return Turn{regions, 0, {}};
  return epipolar_turn(rays, regions, options.noise_px / camera.fx_px);
}

}  // namespace vo
