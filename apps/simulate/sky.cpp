#include "sky.hpp"

#include "canvas.hpp"
#include "noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace simulate {
namespace {

constexpr int kPanels = 8;
constexpr double kRadius_m = 100;  // any: the backdrop has no parallax
constexpr double kBottom_m = -12, kTop_m = 62;

struct Shade {
  Colour zenith, horizon, cloud, skyline;
  double cloudiness;
};

Shade shade_of(Condition condition) {
  switch (condition) {
    case Condition::kNight:
      return {{22, 14, 10}, {46, 34, 30}, {36, 30, 30}, {20, 16, 14}, 0.5};
    case Condition::kRain:
      return {{158, 150, 146}, {175, 170, 166}, {140, 134, 130}, {168, 163, 159}, 0.8};
    case Condition::kDay:
      break;
  }
  return {{205, 150, 95}, {230, 215, 200}, {245, 245, 243}, {150, 140, 130}, 0.6};
}

// The panorama is painted by direction: `around` in turns clockwise from south, `up` the tangent of
// elevation.
cv::Vec3b sky_colour(double around, double up, const Shade& shade, std::uint32_t seed, bool night) {
  // The skyline: houses of their own width and height, hills behind.
  const int column = static_cast<int>(std::floor(around * 160));
  const double house =
      0.015 + 0.075 * lattice_uniform(column, 0, seed) * lattice_uniform(column / 3, 1, seed);
  const double hill = 0.05 + 0.05 * fractal_noise(static_cast<float>(around * 14), 0, 5, seed + 3);
  Colour colour;
  if (up < house) {
    colour = scaled(shade.skyline, 0.75 + 0.5 * lattice_uniform(column, 2, seed));
    const int wx = static_cast<int>(std::floor(around * 1600)), wy = static_cast<int>(std::floor(up * 150));
    if (lattice_uniform(wx, wy, seed + 5) < 0.25F) {
      colour = night ? (lattice_uniform(wx, wy, seed + 6) < 0.3F ? Colour(70, 130, 170) : colour)
                     : scaled(colour, 0.8);
    }
  } else if (up < hill) {
    colour = scaled(shade.skyline, 0.9 + 0.15 * fractal_noise(static_cast<float>(around * 200),
                                                              static_cast<float>(up * 60), 4, seed + 4));
  } else {
    const double height = std::clamp(up / 0.6, 0.0, 1.0);
    colour = shade.horizon * (1 - height) + shade.zenith * height;
    const double cover =
        fractal_noise(static_cast<float>(around * 24), static_cast<float>(up * 9), 6, seed + 7);
    const double cloud = std::clamp((cover + shade.cloudiness - 0.55) * 3, 0.0, 1.0) * (0.75 + 0.25 * cover);
    colour = colour * (1 - cloud) + shade.cloud * cloud;
  }
  return {cv::saturate_cast<std::uint8_t>(colour[0]), cv::saturate_cast<std::uint8_t>(colour[1]),
          cv::saturate_cast<std::uint8_t>(colour[2])};
}

}  // namespace

void add_sky(std::uint64_t seed, Condition condition, WorldBuilder& builder) {
  const Shade shade = shade_of(condition);
  const auto seed32 = static_cast<std::uint32_t>(seed * 0x85ebca6bU + 17);
  const bool night = condition == Condition::kNight;
  const auto corner =
      [](int panel) -> Eigen::Vector2d {  // clockwise from south, so that the seam lies behind the walker
    const double angle = 2 * std::numbers::pi * panel / kPanels + std::numbers::pi;
    return Eigen::Vector2d(std::sin(angle), std::cos(angle)) * kRadius_m;
  };
  for (int panel = 0; panel < kPanels; ++panel) {
    const Eigen::Vector2d a = corner(panel), b = corner(panel + 1), edge = b - a;
    builder.add_backdrop({a.x(), a.y(), kTop_m}, {edge.x(), edge.y(), 0}, {0, 0, kBottom_m - kTop_m},
                         {360, 330}, [=](cv::Size texels) {
                           Painting painting;
                           painting.colour.create(texels);
                           for (int y = 0; y < texels.height; ++y) {
                             for (int x = 0; x < texels.width; ++x) {
                               const double around = (panel + (x + 0.5) / texels.width) / kPanels;
                               const double up =
                                   std::lerp(kTop_m, kBottom_m, (y + 0.5) / texels.height) / kRadius_m;
                               painting.colour(y, x) = sky_colour(around, up, shade, seed32, night);
                             }
                           }
                           return painting;
                         });
  }
}

}  // namespace simulate
