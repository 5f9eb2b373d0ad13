#pragma once

#include <cstdint>

#include <vo/base/rng.hpp>
#include <vo/image/image_stack.hpp>

namespace test_support {

/// Images of independent uniform bytes: any two of them are as unlike as any others.
inline vo::ImageStack random_images(int width, int height, std::size_t count, std::uint64_t seed) {
  vo::Rng rng(seed);
  vo::ImageStack stack = vo::make_image_stack(width, height, count);
  for (auto& pixel : stack.pixels) pixel = static_cast<std::uint8_t>(rng.index(256));
  return stack;
}

}  // namespace test_support
