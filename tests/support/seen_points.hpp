#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <vo/base/pose3.hpp>
#include <vo/base/rng.hpp>
#include <vo/geometry/triangulation.hpp>
#include <vo/tracks/view_points.hpp>

namespace test_support {

/// Points of space with descriptors of their own, for views that were never pictures.
struct MarkedPoints {
  std::vector<cv::Vec3d> points;
  std::vector<std::int8_t> steps;  ///< 64 for each, -7 to 7, as they are packed
};

/// `seed` of the descriptors: another one looks like another place.
inline MarkedPoints marked_points(std::vector<cv::Vec3d> points, std::uint64_t seed) {
  vo::Rng rng(seed);
  MarkedPoints marked{.points = std::move(points), .steps = {}};
  for (std::size_t i = 0; i < marked.points.size() * vo::ViewPoints::kValues; ++i)
    marked.steps.push_back(static_cast<std::int8_t>(static_cast<int>(rng.index(15)) - 7));
  return marked;
}

/// One packed point, byte by byte as the header of `vo::pack_view_points` says.
inline void pack_point(std::vector<std::uint8_t>& bytes, double azimuth_rad, double elevation_rad,
                       std::uint8_t size, const std::int8_t* steps) {
  constexpr double kStep_rad = std::numbers::pi / 65536;
  for (const double angle : {azimuth_rad, elevation_rad}) {
    const auto whole = static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(angle / kStep_rad)));
    bytes.push_back(static_cast<std::uint8_t>(whole & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(whole >> 8U));
  }
  bytes.push_back(size);
  for (std::size_t v = 0; v < vo::ViewPoints::kValues; v += 2)
    bytes.push_back(static_cast<std::uint8_t>((steps[v] + 7) | ((steps[v + 1] + 7) << 4)));
}

/// What a camera sees of them, packed, with normal noise on the image plane.
inline std::vector<std::uint8_t> packed_view(const vo::Pose3& camera, const MarkedPoints& marked,
                                             double noise = 0, std::uint64_t seed = 1) {
  vo::Rng rng(seed);
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < marked.points.size(); ++i) {
    const auto at = vo::project(camera, marked.points[i]);
    if (!at) continue;
    const double x = at->x + noise * rng.normal(), y = at->y + noise * rng.normal();
    pack_point(bytes, std::atan(x), std::atan2(y, std::hypot(x, 1)), 64,
               marked.steps.data() + i * vo::ViewPoints::kValues);
  }
  return bytes;
}

}  // namespace test_support
