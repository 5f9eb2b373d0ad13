#pragma once

#include "texture.hpp"

#include <memory>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace simulate {

/// A textured parallelogram in the world, seen from both sides: the texture's top left corner lies at
/// `corner`, its width runs along `across` and its height along `down`, all in metres.
struct Surface {
  Eigen::Vector3d corner;
  Eigen::Vector3d across;
  Eigen::Vector3d down;
  std::shared_ptr<const Texture> texture;
  double gain = 1;  ///< brightness, 0 to 1, for what moves through baked light
};

/// A pinhole camera without distortion; x right, y down, z forward. The principal point is the image centre.
struct Camera {
  Eigen::Isometry3d world_from_camera = Eigen::Isometry3d::Identity();
  cv::Size size{640, 360};
  double focal_px = 508;

  /// Where a point of the world falls, in pixels; pixel (0, 0) covers [0, 1) x [0, 1). It must lie in front.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& point) const;
};

/// How finely slanting textures are read: 1 to 3 taps along the longer side of a pixel's footprint. One, a
/// little blurred, will do for pictures that are averaged.
inline constexpr int kFineTaps = 3;

/// Exponential haze: what is `distance_m` away keeps 1/e of its own colour.
struct Haze {
  cv::Vec3b bgr{0, 0, 0};
  double distance_m = 1e9;
};

/// Draws surfaces nearest first into a CV_8UC3 image of the camera's size, black where there is none.
///
/// For a parallelogram seen by a pinhole, 1/z, u/z and v/z are linear in the pixel, so that texture
/// coordinates are exact in perspective without per-vertex clipping. Bilinear within a mip level, linear
/// between two levels, with up to `max_taps` taps. What is in front at each pixel is settled first, on 1/z,
/// and only that is textured. `backdrop` is what lies at infinity: its surfaces are relative to the camera's
/// position, unhazed, and are drawn behind everything else.
///
/// Bands of rows run in parallel; the bytes are the same for any number of threads.
void rasterise(const std::vector<Surface>& surfaces, const std::vector<Surface>& backdrop,
               const Camera& camera, const Haze& haze, cv::Mat& bgr, int max_taps = kFineTaps);

}  // namespace simulate
