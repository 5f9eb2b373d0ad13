#include "vo/visual_odometry/ground_height.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vo {
namespace {

/// Kernel density at a value, times the kernel's width, and the weighted mean of the values.
struct Peak {
  double support = 0;
  double mean = 0;
};

/// `sorted`: ascending.
Peak density_at(std::span<const double> sorted, double at, double spread) {
  constexpr double kReach = 3;  // of the kernel, in standard deviations
  Peak peak;
  const auto first = std::ranges::lower_bound(sorted, at - kReach * spread);
  for (auto value = first; value != sorted.end() && *value <= at + kReach * spread; ++value) {
    const double off = (*value - at) / spread;
    const double weight = std::exp(-0.5 * off * off);
    peak.support += weight;
    peak.mean += weight * *value;
  }
  if (peak.support > 0) peak.mean /= peak.support;
  return peak;
}

void check(const GroundHeightOptions& options) {
  if (!(options.max_ahead > 0 && options.spread > 0 && options.min_points > 0))
    throw std::invalid_argument("ground height: settings above 0 expected");
}

}  // namespace

std::vector<double> heights_above(const Pose3& camera, const cv::Vec3d& travel,
                                  std::span<const cv::Vec3d> points, const GroundHeightOptions& options) {
  check(options);
  const double length = cv::norm(travel);
  if (!(length > 0)) return {};
  const cv::Vec3d ahead = travel / length;
  const cv::Vec3d y_axis = camera.rotation * cv::Vec3d(0, 1, 0);
  const cv::Vec3d down = y_axis - y_axis.dot(ahead) * ahead;
  const double level = cv::norm(down);
  if (!(level > 0)) return {};
  std::vector<double> heights;
  for (const cv::Vec3d& point : points) {
    const cv::Vec3d to_point = point - camera.position;
    const double below = to_point.dot(down) / level, off = to_point.dot(ahead);
    if (below > 0 && off > 0 && off <= options.max_ahead * below) heights.push_back(below);
  }
  return heights;
}

std::optional<double> ground_height(std::span<const double> heights,
                                    const std::optional<ExpectedHeight>& expected,
                                    const GroundHeightOptions& options) {
  check(options);
  if (expected && !(expected->height > 0 && expected->sigma > 0))
    throw std::invalid_argument("ground_height: an expectation above 0 expected");
  std::vector<double> logarithms;
  for (const double height : heights) logarithms.push_back(std::log(height));
  std::ranges::sort(logarithms);
  const auto likely = [&](double at) {
    const double off = expected ? (at - std::log(expected->height)) / expected->sigma : 0;
    return std::exp(-0.5 * off * off);
  };
  Peak best;
  double best_weight = 0;
  for (const double at : logarithms) {
    const Peak peak = density_at(logarithms, at, options.spread);
    if (peak.support < options.min_points || peak.support * likely(at) <= best_weight) continue;
    best = peak;
    best_weight = peak.support * likely(at);
  }
  if (!(best_weight > 0)) return std::nullopt;
  // From the best of the points to the top of the peak (mean shift).
  constexpr int kIterations = 10;
  for (int i = 0; i < kIterations; ++i) best = density_at(logarithms, best.mean, options.spread);
  return std::exp(best.mean);
}

}  // namespace vo
