#include "rasteriser.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <vo/base/parallel.hpp>

namespace simulate {
namespace {

constexpr float kNear_m = 0.1F;
constexpr double kFar_m = 250;  // corners hide what is further along the route; the backdrop is exempt
constexpr int kBandRows = 12;
constexpr int kBlock = 8;       // pixels that share a mip level and a haze weight
constexpr int kMaxSamples = 3;  // along the longer side of a pixel's footprint

// A linear function of the pixel: value = at(x, y) = x * dx + y * dy + c.
struct Plane {
  float dx, dy, c;
  [[nodiscard]] float at(float x, float y) const { return x * dx + y * dy + c; }
};

// A surface ready to be drawn: its outline in the image and what is linear over it.
struct Facet {
  const Texture* texture;
  float nearest_m;
  float gain;
  bool hazed;
  Plane inverse_z, u_over_z, v_over_z;
  std::array<Eigen::Vector2f, 5> outline;  // convex
  int corners;
  int top, bottom;  // rows [top, bottom)
};

Plane pixel_plane(const Eigen::Vector3d& ray_coefficients, const Camera& camera) {
  const Eigen::Vector3d& a = ray_coefficients;
  const double f = camera.focal_px;
  const double c = a.z() - a.x() * camera.size.width / (2 * f) - a.y() * camera.size.height / (2 * f);
  return {static_cast<float>(a.x() / f), static_cast<float>(a.y() / f), static_cast<float>(c)};
}

// The outline clipped to what lies beyond the near plane. False if nothing is left in the image.
bool project_outline(const std::array<Eigen::Vector3d, 4>& quad, const Camera& camera, Facet& facet) {
  facet.corners = 0;
  const auto emit = [&](const Eigen::Vector3d& p) {
    facet.outline[static_cast<std::size_t>(facet.corners++)] = {
        static_cast<float>(camera.focal_px * p.x() / p.z() + camera.size.width / 2.0),
        static_cast<float>(camera.focal_px * p.y() / p.z() + camera.size.height / 2.0)};
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d& a = quad[i];
    const Eigen::Vector3d& b = quad[(i + 1) % 4];
    if (a.z() >= kNear_m) emit(a);
    if ((a.z() >= kNear_m) != (b.z() >= kNear_m)) emit(a + (b - a) * ((kNear_m - a.z()) / (b.z() - a.z())));
  }
  if (facet.corners < 3) return false;
  Eigen::Vector2f low = facet.outline[0];
  Eigen::Vector2f high = low;
  for (int i = 1; i < facet.corners; ++i) {
    low = low.cwiseMin(facet.outline[static_cast<std::size_t>(i)]);
    high = high.cwiseMax(facet.outline[static_cast<std::size_t>(i)]);
  }
  const auto width = static_cast<float>(camera.size.width);
  const auto height = static_cast<float>(camera.size.height);
  if (high.x() < 0 || low.x() > width || high.y() < 0 || low.y() > height) return false;
  facet.top = static_cast<int>(std::ceil(std::max(low.y(), 0.0F) - 0.5F));
  facet.bottom = static_cast<int>(std::ceil(std::min(high.y(), height) - 0.5F));
  return facet.top < facet.bottom;
}

void add_facet(const Surface& surface, const Eigen::Isometry3d& camera_from_world, const Camera& camera,
               bool backdrop, std::vector<Facet>& facets) {
  const Eigen::Matrix3d rotation = camera_from_world.linear();
  const Eigen::Vector3d o =
      backdrop ? Eigen::Vector3d(rotation * surface.corner) : camera_from_world * surface.corner;
  const Eigen::Vector3d e1 = rotation * surface.across;
  const Eigen::Vector3d e2 = rotation * surface.down;
  const std::array<Eigen::Vector3d, 4> quad{o, o + e1, o + e1 + e2, o + e2};
  const auto [nearest, furthest] = std::minmax({quad[0].z(), quad[1].z(), quad[2].z(), quad[3].z()});
  if (furthest < kNear_m || (!backdrop && nearest > kFar_m)) return;

  // o + u e1 + v e2 = z d for the ray d of a pixel; Cramer's rule gives 1/z, u/z and v/z, each linear in d.
  const Eigen::Vector3d normal = e1.cross(e2);
  const double volume = o.dot(normal);
  if (std::abs(volume) < 1e-4 * normal.norm()) return;  // seen edge on

  Facet facet;
  if (!project_outline(quad, camera, facet)) return;
  facet.texture = surface.texture.get();
  facet.nearest_m = static_cast<float>(nearest);
  facet.gain = static_cast<float>(surface.gain);
  facet.hazed = !backdrop;
  facet.inverse_z = pixel_plane(normal / volume, camera);
  facet.u_over_z = pixel_plane(e2.cross(o) / volume, camera);
  facet.v_over_z = pixel_plane(o.cross(e1) / volume, camera);
  facets.push_back(facet);
}

// The pixels [first, last) of a row whose centres lie in the convex outline.
std::pair<int, int> row_span(const Facet& facet, float y, int width) {
  float left = static_cast<float>(width), right = 0;
  for (int i = 0; i < facet.corners; ++i) {
    const Eigen::Vector2f& a = facet.outline[static_cast<std::size_t>(i)];
    const Eigen::Vector2f& b = facet.outline[static_cast<std::size_t>((i + 1) % facet.corners)];
    if ((a.y() <= y) == (b.y() <= y)) continue;
    const float x = a.x() + (b.x() - a.x()) * ((y - a.y()) / (b.y() - a.y()));
    left = std::min(left, x);
    right = std::max(right, x);
  }
  left = std::clamp(left, 0.0F, static_cast<float>(width));
  right = std::clamp(right, 0.0F, static_cast<float>(width));
  return {static_cast<int>(std::ceil(left - 0.5F)), static_cast<int>(std::ceil(right - 0.5F))};
}

// Texels are worked on as four 16-bit lanes: blue, red, green, alpha.
std::uint64_t lanes(std::uint32_t texel) {
  return (texel & 0x00ff00ffU) | (static_cast<std::uint64_t>(texel & 0xff00ff00U) << 24U);
}

constexpr std::uint64_t kLaneLow = 0x00ff00ff00ff00ffU;

// Bilinear at (u, v) in [0, 1]; each lane ends up in 0..255.
std::uint64_t sample_level(const Texture::Level& level, float u, float v) {
  const float x =
      std::clamp(u * static_cast<float>(level.width) - 0.5F, 0.0F, static_cast<float>(level.width - 1));
  const float y =
      std::clamp(v * static_cast<float>(level.height) - 0.5F, 0.0F, static_cast<float>(level.height - 1));
  const auto x256 = static_cast<std::uint32_t>(x * 256.0F);
  const auto y16 = static_cast<std::uint32_t>(y * 16.0F);
  const std::uint32_t fx = (x256 & 255U) >> 4U;  // weights in sixteenths: their products sum to 256
  const std::uint32_t fy = y16 & 15U;
  const auto stride = static_cast<std::size_t>(level.width) + 1;
  const std::uint32_t* texel = level.texels + (y16 >> 4U) * stride + (x256 >> 8U);
  const std::uint64_t sum = lanes(texel[0]) * ((16 - fx) * (16 - fy)) + lanes(texel[1]) * (fx * (16 - fy)) +
                            lanes(texel[stride]) * ((16 - fx) * fy) + lanes(texel[stride + 1]) * (fx * fy);
  return (sum >> 8U) & kLaneLow;
}

// log2 to within 0.09: the exponent, and the mantissa taken as linear.
float fast_log2(float x) {
  return static_cast<float>(std::bit_cast<std::uint32_t>(x)) * 0x1.0p-23F - 127.0F;
}

// How a block of pixels reads its texture: which two levels, how much of the second, how many taps and where.
struct Filter {
  Texture::Level fine, coarse;
  std::uint32_t coarse_weight;  // of 16
  int taps;
  float tap_du, tap_dv;
};

Filter choose_filter(const Facet& facet, float u, float v, float z) {
  const Texture::Level base = facet.texture->level(0);
  const auto width = static_cast<float>(base.width);
  const auto height = static_cast<float>(base.height);
  const float ux = (facet.u_over_z.dx - u * facet.inverse_z.dx) * z;
  const float vx = (facet.v_over_z.dx - v * facet.inverse_z.dx) * z;
  const float uy = (facet.u_over_z.dy - u * facet.inverse_z.dy) * z;
  const float vy = (facet.v_over_z.dy - v * facet.inverse_z.dy) * z;
  const float along_x = ux * ux * width * width + vx * vx * height * height;
  const float along_y = uy * uy * width * width + vy * vy * height * height;
  const bool x_is_longer = along_x > along_y;
  const float longer = std::max(std::max(along_x, along_y), 1e-6F);
  const float shorter = std::max(std::min(along_x, along_y), 1e-6F);

  Filter filter;
  // Squared lengths: 2.25 = 1.5^2 is where two taps are nearer than one, 6.25 = 2.5^2 three nearer than two.
  const float ratio = longer < 1 ? 1 : longer / shorter;
  filter.taps = ratio < 2.25F ? 1 : ratio < 6.25F ? 2 : kMaxSamples;
  const auto taps = static_cast<float>(filter.taps);
  filter.tap_du = (x_is_longer ? ux : uy) / taps;
  filter.tap_dv = (x_is_longer ? vx : vy) / taps;
  const float lod = std::clamp(0.5F * fast_log2(longer / (taps * taps)), 0.0F,
                               static_cast<float>(facet.texture->level_count() - 1));
  const int fine = static_cast<int>(lod);
  filter.fine = facet.texture->level(fine);
  filter.coarse_weight = static_cast<std::uint32_t>((lod - static_cast<float>(fine)) * 16.0F);
  filter.coarse = filter.coarse_weight > 0 ? facet.texture->level(fine + 1) : filter.fine;
  return filter;
}

std::uint64_t sample(const Filter& filter, float u, float v) {
  static constexpr std::array<std::uint64_t, kMaxSamples + 1> kTapWeight{0, 256, 128, 85};
  const float first = 0.5F * static_cast<float>(1 - filter.taps);
  u += first * filter.tap_du;
  v += first * filter.tap_dv;
  std::uint64_t sum = 0;
  for (int tap = 0; tap < filter.taps; ++tap, u += filter.tap_du, v += filter.tap_dv) {
    std::uint64_t texel = sample_level(filter.fine, u, v);
    if (filter.coarse_weight > 0) {
      texel =
          ((texel * (16 - filter.coarse_weight) + sample_level(filter.coarse, u, v) * filter.coarse_weight) >>
           4U) &
          kLaneLow;
    }
    sum += texel;
  }
  return filter.taps == 1 ? sum
                          : ((sum * kTapWeight[static_cast<std::size_t>(filter.taps)]) >> 8U) & kLaneLow;
}

// What a frame's pixels are mixed with.
struct Air {
  std::uint64_t haze;
  float inverse_distance;
};

void draw_span(const Facet& facet, int row, int first, int last, const Air& air, float* depth,
               std::uint8_t* bgr) {
  const float y = static_cast<float>(row) + 0.5F;
  const bool opaque = facet.texture->opaque();
  for (int begin = first; begin < last; begin += kBlock) {
    const int end = std::min(begin + kBlock, last);
    // Level and haze are chosen at the block's middle, only if one of its pixels is in front.
    bool chosen = false;
    Filter filter{};
    std::uint64_t own = 256;
    std::uint64_t veil = 0;
    for (int column = begin; column < end; ++column) {
      const float x = static_cast<float>(column) + 0.5F;
      const float inverse_z = facet.inverse_z.at(x, y);
      if (inverse_z <= depth[column]) continue;
      const float z = 1.0F / inverse_z;
      const float u = facet.u_over_z.at(x, y) * z;
      const float v = facet.v_over_z.at(x, y) * z;
      if (!chosen) {
        filter = choose_filter(facet, u, v, z);
        const float keep = facet.hazed ? std::exp(-z * air.inverse_distance) : 1.0F;
        own = static_cast<std::uint64_t>(256.0F * keep * facet.gain);
        veil = air.haze * static_cast<std::uint64_t>(256.0F * (1.0F - keep));
        chosen = true;
      }
      const std::uint64_t texel = sample(filter, u, v);
      if (!opaque && (texel >> 48U) < 128U) continue;
      const std::uint64_t mixed = texel * own + veil;
      depth[column] = inverse_z;
      bgr[3 * column + 0] = static_cast<std::uint8_t>(mixed >> 8U);
      bgr[3 * column + 1] = static_cast<std::uint8_t>(mixed >> 40U);
      bgr[3 * column + 2] = static_cast<std::uint8_t>(mixed >> 24U);
    }
  }
}

}  // namespace

Eigen::Vector2d Camera::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d p = world_from_camera.inverse() * point;
  return {focal_px * p.x() / p.z() + size.width / 2.0, focal_px * p.y() / p.z() + size.height / 2.0};
}

void rasterise(const std::vector<Surface>& surfaces, const std::vector<Surface>& backdrop,
               const Camera& camera, const Haze& haze, cv::Mat& bgr) {
  bgr.create(camera.size, CV_8UC3);
  const Eigen::Isometry3d camera_from_world = camera.world_from_camera.inverse();
  std::vector<Facet> facets;
  for (const Surface& surface : surfaces) add_facet(surface, camera_from_world, camera, false, facets);
  std::ranges::stable_sort(facets, {}, &Facet::nearest_m);
  for (const Surface& surface : backdrop) add_facet(surface, camera_from_world, camera, true, facets);

  const Air air{haze.bgr[0] | static_cast<std::uint64_t>(haze.bgr[2]) << 16U |
                    static_cast<std::uint64_t>(haze.bgr[1]) << 32U,
                static_cast<float>(1 / haze.distance_m)};
  const int width = camera.size.width;
  const int bands = (camera.size.height + kBandRows - 1) / kBandRows;
  vo::parallel_for(static_cast<std::size_t>(bands), [&](std::size_t band) {
    const int top = static_cast<int>(band) * kBandRows;
    const int bottom = std::min(top + kBandRows, camera.size.height);
    bgr.rowRange(top, bottom).setTo(cv::Scalar::all(0));
    std::vector<float> depth(static_cast<std::size_t>(width) * kBandRows, 0.0F);  // 1/z, 0 at infinity
    for (const Facet& facet : facets) {
      for (int row = std::max(top, facet.top); row < std::min(bottom, facet.bottom); ++row) {
        const auto [first, last] = row_span(facet, static_cast<float>(row) + 0.5F, width);
        draw_span(facet, row, first, last, air, depth.data() + static_cast<std::ptrdiff_t>(row - top) * width,
                  bgr.ptr(row));
      }
    }
  });
}

}  // namespace simulate
