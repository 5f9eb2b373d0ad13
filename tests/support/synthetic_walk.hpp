#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vo/base/rng.hpp>
#include <vo/odometry.hpp>

namespace test_support {

/// A wall of smooth random texture that a camera slides along, looking straight at it: what it sees at a
/// place is known exactly, and unlike what it sees a view's width away.
class Wall {
 public:
  static constexpr int kHeight = 32;  ///< pixels, the thumbnail's
  static constexpr int kWidth = 64;   ///< pixels, the thumbnail's
  static constexpr int kPatchPx = 8;  ///< between the random values the texture is smooth

  Wall(int length_px, std::uint64_t seed)
      : columns_((length_px + kWidth) / kPatchPx + 3), values_(static_cast<std::size_t>(columns_ * kRows)) {
    vo::Rng rng(seed);
    for (double& value : values_) value = rng.uniform(20, 235);
  }

  /// The view whose left edge is at `place_px` along the wall.
  [[nodiscard]] std::vector<std::uint8_t> view(double place_px) const {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        pixels.push_back(static_cast<std::uint8_t>(std::lround(at((place_px + x) / kPatchPx, y))));
      }
    }
    return pixels;
  }

  /// A walk at 30 frames/s that is at `place_px[i]` at frame i.
  [[nodiscard]] vo::Walk walk(std::span<const double> place_px, const std::string& name = "wall") const {
    vo::Walk walk;
    walk.source = name;
    walk.frame_width_px = kWidth;
    walk.frame_height_px = kHeight;
    walk.thumbnails = vo::make_image_stack(kWidth, kHeight, 0);
    for (std::size_t i = 0; i < place_px.size(); ++i) {
      walk.time_s.push_back(static_cast<double>(i) / 30);
      const auto pixels = view(place_px[i]);
      walk.thumbnails.pixels.insert(walk.thumbnails.pixels.end(), pixels.begin(), pixels.end());
    }
    return walk;
  }

 private:
  static constexpr int kRows = kHeight / kPatchPx + 1;

  [[nodiscard]] double at(double column, int y) const {
    const int c = static_cast<int>(column), r = y / kPatchPx;
    const double s = column - c, t = static_cast<double>(y % kPatchPx) / kPatchPx;
    return std::lerp(std::lerp(value(c, r), value(c + 1, r), s),
                     std::lerp(value(c, r + 1), value(c + 1, r + 1), s), t);
  }
  [[nodiscard]] double value(int c, int r) const { return values_[static_cast<std::size_t>(c * kRows + r)]; }

  int columns_;
  std::vector<double> values_;
};

/// Places of a walk from `start_px` at the given speeds, pixels per frame: one place more than speeds.
inline std::vector<double> places(double start_px, std::span<const double> speed_px) {
  std::vector<double> place_px{start_px};
  for (const double speed : speed_px) place_px.push_back(place_px.back() + speed);
  return place_px;
}

}  // namespace test_support
