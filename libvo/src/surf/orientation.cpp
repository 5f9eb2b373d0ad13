#include "vo/surf/orientation.hpp"

#include "surf/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vo {
namespace {

constexpr std::size_t kHarmonics = kernels::kOrientationHarmonics;
constexpr std::size_t kDirections = 64;  // at which the peak is looked for
constexpr double kStep_rad = 2 * std::numbers::pi / kDirections;
constexpr double kWindow_rad = 0.40;    // deviation of the window; that of Bay's 60 degrees is 0.30
constexpr double kRadiusDeviation = 3;  // of the weights, in scales
constexpr int kCoarser = 3;             // half octaves of smoothing more than the descriptor's

kernels::OrientationWeights orientation_weights() {
  kernels::OrientationWeights weights{};
  for (int r = 0; r < kernels::kOrientationRows; ++r) {
    for (int c = 0; c < kernels::kOrientationRows; ++c) {
      const int y = r - kernels::kOrientationRadius, x = c - kernels::kOrientationRadius;
      const double squared = x * x + y * y;
      if (squared <= kernels::kOrientationRadius * kernels::kOrientationRadius)
        weights.values[r][c] =
            static_cast<float>(std::exp(-squared / (2 * kRadiusDeviation * kRadiusDeviation)));
    }
  }
  return weights;
}

/// The window's Fourier coefficients, of order m at [m - 1], and its harmonics at every direction d: cosine
/// and sine of m times d, times the coefficient.
struct Window {
  std::array<double, kHarmonics> coefficients;
  std::array<std::array<float, kDirections>, kHarmonics> cosine, sine;

  Window() {
    for (std::size_t m = 0; m < kHarmonics; ++m) {
      const double order = static_cast<double>(m + 1);
      coefficients[m] = std::exp(-0.5 * (order * kWindow_rad) * (order * kWindow_rad));
      for (std::size_t d = 0; d < kDirections; ++d) {
        const double angle = order * static_cast<double>(d) * kStep_rad;
        cosine[m][d] = static_cast<float>(coefficients[m] * std::cos(angle));
        sine[m][d] = static_cast<float>(coefficients[m] * std::sin(angle));
      }
    }
  }
};

/// The direction of those at which the window was tabulated where the most lies in it.
double fullest(const Window& window, const kernels::OrientationMoments& moments) {
  std::array<float, kDirections> sums{};
  for (std::size_t m = 0; m < kHarmonics; ++m) {
    for (std::size_t d = 0; d < kDirections; ++d) {
      sums[d] += moments.values[2 * m] * window.cosine[m][d] + moments.values[2 * m + 1] * window.sine[m][d];
    }
  }
  return static_cast<double>(std::ranges::max_element(sums) - sums.begin()) * kStep_rad;
}

/// Newton's method on the derivative of the series, from a direction beside its peak.
double climb(const Window& window, const kernels::OrientationMoments& moments, double angle) {
  const double begin = angle - kStep_rad, end = angle + kStep_rad;
  for (int iteration = 0; iteration < 4; ++iteration) {
    const double c = std::cos(angle), s = std::sin(angle);
    double cm = 1, sm = 0, slope = 0, curvature = 0;
    for (std::size_t m = 0; m < kHarmonics; ++m) {
      const double next = cm * c - sm * s;
      sm = cm * s + sm * c;
      cm = next;
      const double a = window.coefficients[m] * moments.values[2 * m];
      const double b = window.coefficients[m] * moments.values[2 * m + 1];
      const double order = static_cast<double>(m + 1);
      slope += order * (b * cm - a * sm);
      curvature -= order * order * (a * cm + b * sm);
    }
    if (!(curvature < 0)) break;
    const double change = slope / curvature;
    angle = std::clamp(angle - change, begin, end);
    if (std::abs(change) < 1e-6) break;
  }
  return angle;
}

}  // namespace

float orientation(const SmoothPyramid& pyramid, const Feature& point) {
  static const kernels::OrientationWeights weights = orientation_weights();
  const SmoothLevel& level = pyramid.level(point.scale_px, kCoarser);
  kernels::OrientationMoments moments;
  kernels::kernels().orientation_moments(raster_of(level), grid_at(level, point, point.scale_px, 0), weights,
                                         moments);
  if (std::ranges::all_of(moments.values, [](float moment) { return moment == 0; })) return 0;
  static const Window window;
  const double angle = climb(window, moments, fullest(window, moments));
  const auto wrapped = static_cast<float>(std::remainder(angle, 2 * std::numbers::pi));
  return wrapped <= -std::numbers::pi_v<float> ? std::numbers::pi_v<float> : wrapped;
}

}  // namespace vo
