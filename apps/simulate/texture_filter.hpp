#pragma once

#include "texture.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace simulate {

/// A BGRA colour as four 16-bit lanes, blue the lowest, that are worked on at once: a lane holds 0 to 255,
/// and a weighted sum with weights up to 256 in all fits it.
using Lanes = std::uint64_t;

inline constexpr Lanes kLaneBytes = 0x00ff00ff00ff00ffU;

inline Lanes lanes_of(std::uint32_t texel) {
  const Lanes pairs = (texel | static_cast<Lanes>(texel) << 16U) & 0x0000ffff0000ffffU;
  return (pairs | pairs << 8U) & kLaneBytes;
}
inline int alpha_of(Lanes lanes) {
  return static_cast<int>(lanes >> 48U);
}
/// Writes lanes that are still scaled by 256.
inline void store_bgr(Lanes scaled, std::uint8_t* bgr) {
  bgr[0] = static_cast<std::uint8_t>(scaled >> 8U);
  bgr[1] = static_cast<std::uint8_t>(scaled >> 24U);
  bgr[2] = static_cast<std::uint8_t>(scaled >> 40U);
}

/// The mean of four texels, the left and right ones of two rows, with weights in sixteenths: `right` of the
/// right column, `lower` of the lower row. Rounded down.
inline Lanes bilinear(const std::uint32_t* upper_row, const std::uint32_t* lower_row, int right, int lower) {
#ifdef __SSE2__
  // Eight lanes at once, the same arithmetic.
  const __m128i zero = _mm_setzero_si128();
  const auto load = [&](const std::uint32_t* row) {
    return _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(row)), zero);
  };
  const __m128i down = _mm_set1_epi16(static_cast<short>(lower));
  const __m128i up = _mm_sub_epi16(_mm_set1_epi16(16), down);
  const __m128i column =
      _mm_add_epi16(_mm_mullo_epi16(load(upper_row), up), _mm_mullo_epi16(load(lower_row), down));
  const __m128i across = _mm_unpacklo_epi64(_mm_set1_epi16(static_cast<short>(16 - right)),
                                            _mm_set1_epi16(static_cast<short>(right)));
  const __m128i both = _mm_mullo_epi16(column, across);
  const __m128i sum = _mm_srli_epi16(_mm_add_epi16(both, _mm_unpackhi_epi64(both, both)), 8);
  Lanes result = 0;
  _mm_storel_epi64(reinterpret_cast<__m128i*>(&result), sum);
  return result;
#else
  const auto r = static_cast<Lanes>(right);
  const auto l = static_cast<Lanes>(lower);
  const Lanes sum = lanes_of(upper_row[0]) * ((16 - r) * (16 - l)) + lanes_of(upper_row[1]) * (r * (16 - l)) +
                    lanes_of(lower_row[0]) * ((16 - r) * l) + lanes_of(lower_row[1]) * (r * l);
  return (sum >> 8U) & kLaneBytes;
#endif
}

/// How fast (u, v) change from pixel to pixel along a row (x) and down a column (y).
struct Footprint {
  float ux, vx, uy, vy;
};

/// How pixels with one footprint read a texture: bilinear in the two mip levels that enclose the footprint's
/// size, and up to `max_taps` (1 to 3) times along its longer side if it is a long one (a pavement at a
/// slant).
class TextureFilter {
 public:
  TextureFilter(const Texture& texture, const Footprint& footprint, int max_taps);

  /// The colour at (u, v), clamped to the texture, [0, 1] being all of it.
  [[nodiscard]] Lanes sample(float u, float v) const {
    if (taps_ == 1) return sample_levels(u, v);
    u -= first_ * tap_du_;
    v -= first_ * tap_dv_;
    Lanes sum = 0;
    for (int tap = 0; tap < taps_; ++tap, u += tap_du_, v += tap_dv_) sum += sample_levels(u, v);
    return ((sum * tap_weight_) >> 8U) & kLaneBytes;
  }

 private:
  struct Level {
    const std::uint32_t* texels;
    std::ptrdiff_t stride;
    float scale_x, scale_y;  // to sixteenths of a texel
    float max_x, max_y;
  };

  static Level prepare(const Texture::Level& level);

  static Lanes sample_level(const Level& level, float u, float v) {
    const auto x = static_cast<std::int32_t>(std::clamp(u * level.scale_x - 8.0F, 0.0F, level.max_x));
    const auto y = static_cast<std::int32_t>(std::clamp(v * level.scale_y - 8.0F, 0.0F, level.max_y));
    const std::uint32_t* texel = level.texels + (y >> 4) * level.stride + (x >> 4);
    return bilinear(texel, texel + level.stride, x & 15, y & 15);
  }

  [[nodiscard]] Lanes sample_levels(float u, float v) const {
    const Lanes fine = sample_level(fine_, u, v);
    if (coarse_weight_ == 0) return fine;
    return ((fine * (16 - coarse_weight_) + sample_level(coarse_, u, v) * coarse_weight_) >> 4U) & kLaneBytes;
  }

  Level fine_, coarse_;
  Lanes coarse_weight_ = 0;  // of 16
  int taps_ = 1;
  Lanes tap_weight_ = 256;  // of 256
  float first_ = 0;         // the first tap, in taps before the middle
  float tap_du_ = 0, tap_dv_ = 0;
};

}  // namespace simulate
