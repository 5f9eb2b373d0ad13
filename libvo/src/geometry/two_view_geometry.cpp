#include "vo/geometry/two_view_geometry.hpp"

#include "vo/base/median.hpp"
#include "vo/geometry/triangulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <opencv2/calib3d.hpp>

namespace vo {
namespace {

/// A point more standard deviations away than this does not fit (95 % with two degrees of freedom).
constexpr double kFit = 2.45;

cv::Vec3d ray(const ImagePoint& p) {
  return cv::normalize(cv::Vec3d(p.x, p.y, 1));
}

cv::UsacParams usac(double threshold, int seed) {
  cv::UsacParams params;
  params.confidence = 0.999;
  params.maxIterations = 1000;
  params.threshold = threshold;
  params.randomGeneratorState = seed;
  params.isParallel = false;
  params.score = cv::SCORE_METHOD_MSAC;
  params.sampler = cv::SAMPLING_UNIFORM;
  params.loMethod = cv::LOCAL_OPTIM_INNER_LO;
  params.loIterations = 10;
  params.loSampleSize = 20;
  return params;
}

/// Squared Sampson distances of b' E a = 0.
std::vector<double> epipolar_errors(const cv::Matx33d& e, std::span<const ImagePoint> from,
                                    std::span<const ImagePoint> to) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const cv::Vec3d a(from[i].x, from[i].y, 1), b(to[i].x, to[i].y, 1);
    const cv::Vec3d line_b = e * a, line_a = e.t() * b;
    const double size =
        line_b[0] * line_b[0] + line_b[1] * line_b[1] + line_a[0] * line_a[0] + line_a[1] * line_a[1];
    const double error = b.dot(line_b);
    errors.push_back(size > 0 ? error * error / size : 0);
  }
  return errors;
}

/// Squared distances from where the homography maps each point, halved: both ends have noise.
std::vector<double> planar_errors(const cv::Matx33d& h, std::span<const ImagePoint> from,
                                  std::span<const ImagePoint> to) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const cv::Vec3d b = h * cv::Vec3d(from[i].x, from[i].y, 1);
    const double x = b[0] / b[2] - to[i].x, y = b[1] / b[2] - to[i].y;
    errors.push_back((x * x + y * y) / 2);
  }
  return errors;
}

/// Torr's geometric robust information criterion, for points in four dimensions. `structure`: dimensions of
/// the manifold they lie on; `parameters`: of the model.
double gric(const std::vector<double>& squared, double noise, int structure, int parameters) {
  constexpr double kDimensions = 4, kOutlier = 2;
  const auto count = static_cast<double>(squared.size());
  double sum = 0;
  for (const double error : squared)
    sum += std::min(error / (noise * noise), kOutlier * (kDimensions - structure));
  return sum + std::log(kDimensions) * structure * count + std::log(kDimensions * count) * parameters;
}

/// The points as a solution explains them.
TwoViewGeometry place_points(const Pose3& second, const std::vector<double>& squared,
                             std::span<const ImagePoint> from, std::span<const ImagePoint> to, double noise) {
  TwoViewGeometry geometry{.second = second};
  geometry.points.resize(from.size());
  const std::array<Pose3, 2> cameras{Pose3{}, second};
  std::vector<double> parallax;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (squared[i] > kFit * kFit * noise * noise) continue;
    const std::optional<cv::Vec3d> point = triangulate(cameras, std::array{from[i], to[i]});
    if (!point) continue;
    const ImagePoint a = *project(cameras[0], *point), b = *project(cameras[1], *point);
    const double limit = 2 * kFit * noise;
    if (std::hypot(a.x - from[i].x, a.y - from[i].y) > limit ||
        std::hypot(b.x - to[i].x, b.y - to[i].y) > limit) {
      continue;
    }
    geometry.points[i] = point;
    parallax.push_back(angle_between_rad(ray_of(cameras[0], from[i]), ray_of(cameras[1], to[i])));
  }
  geometry.inliers = parallax.size();
  if (!parallax.empty()) geometry.parallax_rad = median(parallax);
  return geometry;
}

/// The inverse of OpenCV's second_from_first.
Pose3 inverse_of(const cv::Mat& rotation, const cv::Mat& translation) {
  const cv::Matx33d r(rotation.ptr<double>());
  const cv::Vec3d t(translation.ptr<double>());
  return {.rotation = r.t(), .position = -(r.t() * cv::normalize(t))};
}

std::vector<Pose3> solutions_of_essential(const cv::Mat& e) {
  cv::Mat r1, r2, t;
  cv::decomposeEssentialMat(e, r1, r2, t);
  return {inverse_of(r1, t), inverse_of(r1, -t), inverse_of(r2, t), inverse_of(r2, -t)};
}

std::vector<Pose3> solutions_of_homography(const cv::Mat& h) {
  std::vector<cv::Mat> rotations, translations, normals;
  cv::decomposeHomographyMat(h, cv::Matx33d::eye(), rotations, translations, normals);
  std::vector<Pose3> solutions;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    constexpr double kStill = 1e-6;
    if (cv::norm(translations[i]) > kStill) solutions.push_back(inverse_of(rotations[i], translations[i]));
  }
  return solutions;
}

}  // namespace

ViewRotation view_rotation(std::span<const ImagePoint> from, std::span<const ImagePoint> to, double noise) {
  if (from.size() != to.size() || from.size() < 2)
    throw std::invalid_argument("view_rotation: the same points in both views, 2 or more, expected");
  ViewRotation result;
  result.off.assign(from.size(), 0);
  constexpr int kRounds = 12;
  double scale = std::numeric_limits<double>::infinity();  // at first all points have equal weight
  for (int round = 0; round < kRounds; ++round) {
    cv::Matx33d sum = cv::Matx33d::zeros();
    for (std::size_t i = 0; i < from.size(); ++i) {
      const double off = result.off[i] / scale;
      sum += ray(from[i]) * ray(to[i]).t() * (1 / (1 + off * off));
    }
    cv::Vec3d w;
    cv::Matx33d u, vt;
    cv::SVD::compute(sum, w, u, vt);
    const double sign = cv::determinant(u * vt) < 0 ? -1 : 1;
    result.rotation = u * cv::Matx33d::diag({1, 1, sign}) * vt;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const cv::Vec3d p = result.rotation.t() * cv::Vec3d(from[i].x, from[i].y, 1);
      result.off[i] = p[2] > 0 ? std::hypot(p[0] / p[2] - to[i].x, p[1] / p[2] - to[i].y)
                               : std::numeric_limits<double>::max();
    }
    scale = std::max(2 * noise, median(result.off));
  }
  return result;
}

std::optional<TwoViewGeometry> two_view_geometry(std::span<const ImagePoint> from,
                                                 std::span<const ImagePoint> to,
                                                 const TwoViewOptions& options) {
  if (from.size() != to.size())
    throw std::invalid_argument("two_view_geometry: the same points in both views expected");
  constexpr std::size_t kLeast = 8;
  if (from.size() < std::max(kLeast, options.min_inliers)) return std::nullopt;
  std::vector<cv::Point2d> a, b;
  for (std::size_t i = 0; i < from.size(); ++i) {
    a.emplace_back(from[i].x, from[i].y);
    b.emplace_back(to[i].x, to[i].y);
  }
  const cv::UsacParams params = usac(kFit * options.noise, options.seed);
  const cv::Mat eye = cv::Mat::eye(3, 3, CV_64F);
  const cv::Mat e = cv::findEssentialMat(a, b, eye, eye, cv::noArray(), cv::noArray(), cv::noArray(), params);
  const cv::Mat h = cv::findHomography(a, b, cv::noArray(), params);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> by_e, by_h;
  double gric_e = kNone, gric_h = kNone;
  if (e.rows == 3 && e.cols == 3) {
    by_e = epipolar_errors(cv::Matx33d(e.ptr<double>()), from, to);
    gric_e = gric(by_e, options.noise, 3, 5);
  }
  if (h.rows == 3 && h.cols == 3) {
    by_h = planar_errors(cv::Matx33d(h.ptr<double>()), from, to);
    gric_h = gric(by_h, options.noise, 2, 8);
  }
  if (gric_e == kNone && gric_h == kNone) return std::nullopt;
  const bool planar = gric_h < gric_e;

  std::optional<TwoViewGeometry> best;
  std::size_t second_best = 0;
  for (const Pose3& second : planar ? solutions_of_homography(h) : solutions_of_essential(e)) {
    TwoViewGeometry geometry = place_points(second, planar ? by_h : by_e, from, to, options.noise);
    if (!best || geometry.inliers > best->inliers) {
      second_best = best ? best->inliers : 0;
      best = std::move(geometry);
    } else {
      second_best = std::max(second_best, geometry.inliers);
    }
  }
  constexpr double kAmbiguous = 0.75;
  if (!best || best->inliers < options.min_inliers ||
      static_cast<double>(second_best) > kAmbiguous * static_cast<double>(best->inliers)) {
    return std::nullopt;
  }
  best->planar = planar;
  return best;
}

}  // namespace vo
