#pragma once

#include "options.hpp"
#include "rasteriser.hpp"

#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace simulate {

/// What a surface is made of, before light falls on it.
struct Painting {
  cv::Mat3b colour;  ///< as seen in full daylight
  cv::Mat3b glow;    ///< light of its own (windows, signs) added by night; empty: none
  cv::Mat1b alpha;   ///< 0 where cut out; empty: none
};

/// A street lamp or a ceiling light.
struct Lamp {
  Eigen::Vector3d position;
  cv::Vec3f bgr;  ///< brightness straight below, 1 being full daylight on a wall
};

/// The light of a place. It does not move, so it is baked into each surface's texture once.
class Lighting {
 public:
  Lighting(Scene scene, Condition condition, std::vector<Lamp> lamps);

  /// Light, per channel, on a point of a surface with this outward unit normal. A zero normal stands for
  /// leaves and the like, lit from every side.
  [[nodiscard]] cv::Vec3f at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  [[nodiscard]] const Haze& haze() const { return haze_; }
  [[nodiscard]] bool night() const { return condition_ == Condition::kNight; }

 private:
  Condition condition_;
  std::vector<Lamp> lamps_;
  cv::Vec3f ambient_;
  cv::Vec3f sun_;
  Haze haze_;
};

/// Lights a painting as it hangs in the world. The light is worked out every 0.5 m and interpolated. A
/// painting with alpha is lit from every side.
cv::Mat4b bake(const Painting& painting, const Surface& surface, const Lighting& lighting);

/// A painting in light of one strength everywhere, without its glow.
cv::Mat4b bake_evenly(const Painting& painting, const cv::Vec3f& light);

}  // namespace simulate
