#include "vo/surf/orientation.hpp"

#include "surf/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vo {
namespace {

constexpr int kHarmonics = kernels::kOrientationHarmonics;
constexpr int kDirections = 64;           // at which the peak is looked for
constexpr double kWindow_rad = 0.40;      // deviation of the window; that of Bay's 60 degrees is 0.30
constexpr double kRadiusDeviation = 2.5;  // of the weights, in scales
constexpr int kCoarser = 1;               // half octaves of smoothing more than the descriptor's

kernels::OrientationWeights make_weights() {
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

/// The window's Fourier coefficient of order m.
double window(int m) {
  return std::exp(-0.5 * (m * kWindow_rad) * (m * kWindow_rad));
}

/// harmonics[m - 1][d]: cosine and sine of m times direction d, times the window's coefficient.
struct Directions {
  std::array<std::array<float, kDirections>, kHarmonics> cosine, sine;

  Directions() {
    for (int m = 1; m <= kHarmonics; ++m) {
      for (int d = 0; d < kDirections; ++d) {
        const double angle = m * 2 * std::numbers::pi * d / kDirections;
        cosine[m - 1][d] = static_cast<float>(window(m) * std::cos(angle));
        sine[m - 1][d] = static_cast<float>(window(m) * std::sin(angle));
      }
    }
  }
};

/// The direction d of which the series is greatest.
int greatest(const kernels::OrientationMoments& moments) {
  static const Directions directions;
  std::array<float, kDirections> density{};
  for (int m = 0; m < kHarmonics; ++m) {
    for (int d = 0; d < kDirections; ++d)
      density[d] +=
          moments.values[2 * m] * directions.cosine[m][d] + moments.values[2 * m + 1] * directions.sine[m][d];
  }
  return static_cast<int>(std::ranges::max_element(density) - density.begin());
}

/// Newton's method on the derivative of the series, from a direction beside its peak.
double climb(const kernels::OrientationMoments& moments, double angle) {
  constexpr double kReach = 2 * std::numbers::pi / kDirections;
  const double begin = angle - kReach, end = angle + kReach;
  for (int iteration = 0; iteration < 4; ++iteration) {
    const double c = std::cos(angle), s = std::sin(angle);
    double cm = 1, sm = 0, slope = 0, curvature = 0;
    for (int m = 1; m <= kHarmonics; ++m) {
      const double next = cm * c - sm * s;
      sm = cm * s + sm * c;
      cm = next;
      const double a = window(m) * moments.values[2 * m - 2], b = window(m) * moments.values[2 * m - 1];
      slope += m * (b * cm - a * sm);
      curvature -= m * m * (a * cm + b * sm);
    }
    if (!(curvature < 0)) break;
    angle = std::clamp(angle - slope / curvature, begin, end);
  }
  return angle;
}

}  // namespace

float orientation(const SmoothPyramid& pyramid, const Feature& point) {
  static const kernels::OrientationWeights weights = make_weights();
  const SmoothLevel& level = pyramid.level(point.scale_px, kCoarser);
  kernels::OrientationMoments moments;
  kernels::kernels().orientation_moments(raster_of(level), grid_at(level, point, point.scale_px, 0), weights,
                                         moments);
  if (std::ranges::all_of(moments.values, [](float moment) { return moment == 0; })) return 0;
  const double angle = climb(moments, greatest(moments) * 2 * std::numbers::pi / kDirections);
  const auto wrapped = static_cast<float>(std::remainder(angle, 2 * std::numbers::pi));
  return wrapped <= -std::numbers::pi_v<float> ? std::numbers::pi_v<float> : wrapped;
}

bool orientation_inside(const Feature& point, int width_px, int height_px) {
  const float reach = (kernels::kOrientationRadius + 1) * point.scale_px;
  return point.x_px >= reach && point.y_px >= reach &&
         point.x_px <= static_cast<float>(width_px - 1) - reach &&
         point.y_px <= static_cast<float>(height_px - 1) - reach;
}

}  // namespace vo
