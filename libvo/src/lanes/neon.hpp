#pragma once

#include "lanes/lanes.hpp"

#include <arm_neon.h>
#include <cstdint>
#include <cstring>

namespace vo::lanes {

struct Neon {
  static constexpr std::size_t kCount = 4;
  using Float = float32x4_t;
  using Int = int32x4_t;

  static Float load(const float* from) { return vld1q_f32(from); }
  static void store(float* to, Float a) { vst1q_f32(to, a); }
  static Float all_float(float a) { return vdupq_n_f32(a); }
  static Float add(Float a, Float b) { return vaddq_f32(a, b); }
  static Float sub(Float a, Float b) { return vsubq_f32(a, b); }
  static Float mul(Float a, Float b) { return vmulq_f32(a, b); }
  static Float max(Float a, Float b) { return vmaxq_f32(a, b); }
  static Float abs(Float a) { return vabsq_f32(a); }
  static Float sqrt(Float a) { return vsqrtq_f32(a); }

  static Int load(const std::int32_t* from) { return vld1q_s32(from); }
  static void store(std::int32_t* to, Int a) { vst1q_s32(to, a); }
  static Int add(Int a, Int b) { return vaddq_s32(a, b); }
  static Int sub(Int a, Int b) { return vsubq_s32(a, b); }
  static Int half(Int a) { return vshrq_n_s32(a, 1); }
  static Float to_float(Int a) { return vcvtq_f32_s32(a); }
  static Int to_nearest(Float a) { return vcvtnq_s32_f32(a); }

  static constexpr Packing kPacking{.group = 4, .left_offset = 0};
  using Products = int8x16_t;
  static Products load_products(const void* from) { return vld1q_s8(static_cast<const std::int8_t*>(from)); }
  static Products all_products(const void* from) {
    std::int32_t values;
    std::memcpy(&values, from, sizeof values);
    return vreinterpretq_s8_s32(vdupq_n_s32(values));
  }
  static Int add_products(Int sums, Products left, Products right) {
    const int16x8_t low = vmull_s8(vget_low_s8(left), vget_low_s8(right)), high = vmull_high_s8(left, right);
    return vaddq_s32(sums, vpaddq_s32(vpaddlq_s16(low), vpaddlq_s16(high)));
  }
};

}  // namespace vo::lanes
