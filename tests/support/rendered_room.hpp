#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include <vo/base/pose3.hpp>
#include <vo/base/rng.hpp>
#include <vo/geometry/camera.hpp>

namespace test_support {

/// The inside of a long room with two pillars, all of it covered by smooth random texture, as a camera sees
/// it from anywhere within: x right, y down, z ahead, metres, the floor at y = 1.5.
class RenderedRoom {
 public:
  explicit RenderedRoom(std::uint64_t seed = 1) {
    vo::Rng rng(seed);
    for (float& value : values_) value = static_cast<float>(rng.uniform(20, 235));
  }

  [[nodiscard]] cv::Mat view(const vo::Camera& camera, const vo::Pose3& pose) const {
    cv::Mat1b picture(camera.height_px, camera.width_px);
    for (int row = 0; row < picture.rows; ++row) {
      for (int column = 0; column < picture.cols; ++column) {
        const cv::Vec3d ray = pose.rotation * cv::Vec3d((column - camera.cx_px) / camera.fx_px,
                                                        (row - camera.cy_px) / camera.fy_px, 1);
        picture(row, column) = cv::saturate_cast<uchar>(colour(pose.position, ray));
      }
    }
    return picture;
  }

 private:
  static constexpr int kSide = 64;  // of the table of random values

  struct Box {
    cv::Vec3d low, high;
  };

  /// Where the ray meets a face of the box, the nearest ahead or, from inside, the one it leaves by.
  static bool meet(const Box& box, const cv::Vec3d& from, const cv::Vec3d& ray, bool inside, double& at,
                   int& axis) {
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    int enter_axis = 0, leave_axis = 0;
    for (int i = 0; i < 3; ++i) {
      if (std::abs(ray[i]) < 1e-12) {
        if (from[i] < box.low[i] || from[i] > box.high[i]) return false;
        continue;
      }
      const double a = (box.low[i] - from[i]) / ray[i], b = (box.high[i] - from[i]) / ray[i];
      if (std::min(a, b) > enter) enter = std::min(a, b), enter_axis = i;
      if (std::max(a, b) < leave) leave = std::max(a, b), leave_axis = i;
    }
    if (enter > leave) return false;
    at = inside ? leave : enter;
    axis = inside ? leave_axis : enter_axis;
    return at > 0;
  }

  [[nodiscard]] double colour(const cv::Vec3d& from, const cv::Vec3d& ray) const {
    static const std::array<Box, 3> boxes{Box{{-3, -1.5, -8}, {3, 1.5, 14}},
                                          Box{{-1.8, -1.5, 5}, {-1.2, 1.5, 5.6}},
                                          Box{{1.0, -1.5, 8}, {1.6, 1.5, 8.6}}};
    double nearest = std::numeric_limits<double>::infinity();
    int axis = 0, which = 0;
    for (int i = 0; i < 3; ++i) {
      double at = 0;
      int face = 0;
      if (meet(boxes[static_cast<std::size_t>(i)], from, ray, i == 0, at, face) && at < nearest) {
        nearest = at;
        axis = face;
        which = i;
      }
    }
    const cv::Vec3d p = from + ray * nearest;
    const double u = p[(axis + 1) % 3], v = p[(axis + 2) % 3];
    const int offset = 17 * axis + 29 * which;
    return 0.65 * texture(u / 0.45 + offset, v / 0.45) + 0.35 * texture(u / 0.15, v / 0.15 + offset);
  }

  /// Bilinear between random values on a grid that repeats.
  [[nodiscard]] double texture(double u, double v) const {
    const auto cell_u = static_cast<int>(std::floor(u)), cell_v = static_cast<int>(std::floor(v));
    const double s = u - cell_u, t = v - cell_v;
    const auto value = [&](int a, int b) {
      const int i = ((a % kSide) + kSide) % kSide, j = ((b % kSide) + kSide) % kSide;
      return static_cast<double>(values_[static_cast<std::size_t>(i * kSide + j)]);
    };
    return std::lerp(std::lerp(value(cell_u, cell_v), value(cell_u + 1, cell_v), s),
                     std::lerp(value(cell_u, cell_v + 1), value(cell_u + 1, cell_v + 1), s), t);
  }

  std::vector<float> values_ = std::vector<float>(static_cast<std::size_t>(kSide * kSide));
};

/// A camera's pose: turned to the right about the vertical.
inline vo::Pose3 turned(double turn_rad, const cv::Vec3d& position = {0, 0, 0}) {
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  return {.rotation = {c, 0, s, 0, 1, 0, -s, 0, c}, .position = position};
}

}  // namespace test_support
