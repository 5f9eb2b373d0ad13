#include "rasteriser.hpp"

#include "texture_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <vo/base/parallel.hpp>

namespace simulate {
namespace {

constexpr float kNear_m = 0.1F;
constexpr double kFar_m = 250;  // corners hide what is further along the route; the backdrop is exempt
constexpr int kBandRows = 12;
constexpr int kBlock = 16;  // pixels that may share a mip level and a haze weight

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
  // Put a million times further away, a backdrop looks the same and lies behind everything else.
  const Eigen::Matrix3d rotation = camera_from_world.linear() * (backdrop ? 1e6 : 1.0);
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

TextureFilter filter_at(const Facet& facet, float x, float y, int max_taps) {
  const float z = 1.0F / facet.inverse_z.at(x, y);
  const float u = facet.u_over_z.at(x, y) * z;
  const float v = facet.v_over_z.at(x, y) * z;
  return TextureFilter(
      *facet.texture,
      {(facet.u_over_z.dx - u * facet.inverse_z.dx) * z, (facet.v_over_z.dx - v * facet.inverse_z.dx) * z,
       (facet.u_over_z.dy - u * facet.inverse_z.dy) * z, (facet.v_over_z.dy - v * facet.inverse_z.dy) * z},
      max_taps);
}

// One row of the image while it is drawn: which facet is in front at each pixel, and its 1/z (0 at infinity).
struct Row {
  int index;
  std::vector<float> depth;
  std::vector<std::int32_t> front;
};

constexpr std::int32_t kNothing = -1;

void resolve_opaque(const Facet& facet, std::int32_t id, int first, int last, Row& row) {
  const float base = facet.inverse_z.at(0.5F, static_cast<float>(row.index) + 0.5F);
  const float slope = facet.inverse_z.dx;
  float* depth = row.depth.data();
  std::int32_t* front = row.front.data();
  for (int column = first; column < last; ++column) {  // without branches, so that compilers vectorise it
    const float inverse_z = base + slope * static_cast<float>(column);
    const bool nearer = inverse_z > depth[column];
    depth[column] = nearer ? inverse_z : depth[column];
    front[column] = nearer ? id : front[column];
  }
}

void resolve_cut_out(const Facet& facet, std::int32_t id, int first, int last, Row& row) {
  const float y = static_cast<float>(row.index) + 0.5F;
  float* depth = row.depth.data();
  const auto is_nearer = [&](int column) {
    return facet.inverse_z.at(static_cast<float>(column) + 0.5F, y) > depth[column];
  };
  for (int begin = first; begin < last; begin += kBlock) {
    const int end = std::min(begin + kBlock, last);
    int column = begin;
    while (column < end && !is_nearer(column)) ++column;
    if (column == end) continue;
    const TextureFilter filter = filter_at(facet, static_cast<float>(column) + 0.5F, y, 1);
    for (; column < end; ++column) {
      if (!is_nearer(column)) continue;
      const float x = static_cast<float>(column) + 0.5F;
      const float inverse_z = facet.inverse_z.at(x, y);
      if (alpha_of(filter.sample(facet.u_over_z.at(x, y) / inverse_z, facet.v_over_z.at(x, y) / inverse_z)) <
          128) {
        continue;
      }
      depth[column] = inverse_z;
      row.front[static_cast<std::size_t>(column)] = id;
    }
  }
}

// What holds for all of a frame.
struct Look {
  Lanes haze;
  float inverse_distance;
  int max_taps;
};

// Colours pixels [first, last), which all show one facet. They share a mip level and a haze weight.
void shade_block(const Facet& facet, int row, int first, int last, const Look& look, std::uint8_t* bgr) {
  const float y = static_cast<float>(row) + 0.5F;
  const float middle = 0.5F * static_cast<float>(first + last);
  const float middle_z = 1.0F / facet.inverse_z.at(middle, y);
  const TextureFilter filter = filter_at(facet, middle, y, look.max_taps);
  const float keep = facet.hazed ? std::exp(-middle_z * look.inverse_distance) : 1.0F;
  const auto own = static_cast<Lanes>(256.0F * keep * facet.gain);
  const Lanes veil = look.haze * static_cast<Lanes>(256.0F * (1.0F - keep));
  for (int column = first; column < last; ++column) {
    const float x = static_cast<float>(column) + 0.5F;
    const float z = 1.0F / facet.inverse_z.at(x, y);
    const Lanes mixed = filter.sample(facet.u_over_z.at(x, y) * z, facet.v_over_z.at(x, y) * z) * own + veil;
    store_bgr(mixed, bgr + static_cast<std::ptrdiff_t>(3) * column);
  }
}

void shade_row(const std::vector<Facet>& facets, const Row& row, const Look& look, std::uint8_t* bgr) {
  const int width = static_cast<int>(row.front.size());
  for (int begin = 0; begin < width;) {
    const std::int32_t id = row.front[static_cast<std::size_t>(begin)];
    int end = begin + 1;
    while (end < width && end < begin + kBlock && row.front[static_cast<std::size_t>(end)] == id) ++end;
    if (id == kNothing) {
      std::fill(bgr + static_cast<std::ptrdiff_t>(3) * begin, bgr + static_cast<std::ptrdiff_t>(3) * end,
                std::uint8_t{0});
    } else {
      shade_block(facets[static_cast<std::size_t>(id)], row.index, begin, end, look, bgr);
    }
    begin = end;
  }
}

}  // namespace

Eigen::Vector2d Camera::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d p = world_from_camera.inverse() * point;
  return {focal_px * p.x() / p.z() + size.width / 2.0, focal_px * p.y() / p.z() + size.height / 2.0};
}

void rasterise(const std::vector<Surface>& surfaces, const std::vector<Surface>& backdrop,
               const Camera& camera, const Haze& haze, cv::Mat& bgr, int max_taps) {
  bgr.create(camera.size, CV_8UC3);
  const Eigen::Isometry3d camera_from_world = camera.world_from_camera.inverse();
  std::vector<Facet> facets;
  for (const Surface& surface : surfaces) add_facet(surface, camera_from_world, camera, false, facets);
  std::ranges::stable_sort(facets, {}, &Facet::nearest_m);
  for (const Surface& surface : backdrop) add_facet(surface, camera_from_world, camera, true, facets);

  const Look look{lanes_of(static_cast<std::uint32_t>(haze.bgr[0] | haze.bgr[1] << 8 | haze.bgr[2] << 16)),
                  static_cast<float>(1 / haze.distance_m), max_taps};
  const auto width = static_cast<std::size_t>(camera.size.width);
  vo::parallel_for(
      static_cast<std::size_t>((camera.size.height + kBandRows - 1) / kBandRows), [&](std::size_t band) {
        Row row{0, std::vector<float>(width), std::vector<std::int32_t>(width)};
        const int top = static_cast<int>(band) * kBandRows;
        for (row.index = top; row.index < std::min(top + kBandRows, camera.size.height); ++row.index) {
          std::ranges::fill(row.depth, 0.0F);
          std::ranges::fill(row.front, kNothing);
          for (std::size_t i = 0; i < facets.size(); ++i) {
            const Facet& facet = facets[i];
            if (row.index < facet.top || row.index >= facet.bottom) continue;
            const auto [first, last] =
                row_span(facet, static_cast<float>(row.index) + 0.5F, camera.size.width);
            const auto resolve = facet.texture->opaque() ? resolve_opaque : resolve_cut_out;
            resolve(facet, static_cast<std::int32_t>(i), first, last, row);
          }
          shade_row(facets, row, look, bgr.ptr(row.index));
        }
      });
}

}  // namespace simulate
