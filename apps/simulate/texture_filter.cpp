#include "texture_filter.hpp"

#include <algorithm>
#include <bit>

namespace simulate {
namespace {

// log2 to within 0.09: the exponent, and the mantissa taken as linear. A mip level needs no more.
float fast_log2(float x) {
  return static_cast<float>(std::bit_cast<std::uint32_t>(x)) * 0x1.0p-23F - 127.0F;
}

}  // namespace

TextureFilter::Level TextureFilter::prepare(const Texture::Level& level) {
  return {level.texels,
          static_cast<std::ptrdiff_t>(level.width) + 1,
          16.0F * static_cast<float>(level.width),
          16.0F * static_cast<float>(level.height),
          16.0F * static_cast<float>(level.width - 1),
          16.0F * static_cast<float>(level.height - 1)};
}

TextureFilter::TextureFilter(const Texture& texture, const Footprint& footprint, int max_taps) {
  const Texture::Level base = texture.level(0);
  const auto squared_texels = [&](float u, float v) {
    u *= static_cast<float>(base.width);
    v *= static_cast<float>(base.height);
    return std::max(u * u + v * v, 1e-6F);
  };
  const float along_x = squared_texels(footprint.ux, footprint.vx);
  const float along_y = squared_texels(footprint.uy, footprint.vy);
  const bool x_is_longer = along_x > along_y;
  float longer = std::max(along_x, along_y);

  // On squared lengths: two taps fit better than one from a ratio of 1.5 on, three better than two from 2.5
  // on.
  const float ratio = longer / std::min(along_x, along_y);
  if (longer > 1 && ratio > 1.5F * 1.5F) {
    taps_ = std::min(max_taps, ratio > 2.5F * 2.5F ? 3 : 2);
    const float share = 1.0F / static_cast<float>(taps_);
    tap_weight_ = static_cast<Lanes>(256.0F * share);
    tap_du_ = (x_is_longer ? footprint.ux : footprint.uy) * share;
    tap_dv_ = (x_is_longer ? footprint.vx : footprint.vy) * share;
    first_ = 0.5F * static_cast<float>(taps_ - 1);
    longer *= share * share;
  }
  const float detail =
      std::clamp(0.5F * fast_log2(longer), 0.0F, static_cast<float>(texture.level_count() - 1));
  const int fine = static_cast<int>(detail);
  coarse_weight_ = static_cast<Lanes>((detail - static_cast<float>(fine)) * 16.0F);
  fine_ = prepare(texture.level(fine));
  coarse_ = coarse_weight_ > 0 ? prepare(texture.level(fine + 1)) : fine_;
}

}  // namespace simulate
