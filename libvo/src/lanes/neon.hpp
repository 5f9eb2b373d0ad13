#pragma once

#include "lanes/lanes.hpp"

#include <arm_neon.h>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace vo::lanes {

/// 64-bit Arm.
struct Neon {
  static constexpr int kCount = 4;
  using Float = float32x4_t;
  using Int = uint32x4_t;

  static Float load(const float* from) { return vld1q_f32(from); }
  static void store(float* to, Float a) { vst1q_f32(to, a); }
  static Float all(float a) { return vdupq_n_f32(a); }
  static Float add(Float a, Float b) { return vaddq_f32(a, b); }
  static Float sub(Float a, Float b) { return vsubq_f32(a, b); }
  static Float mul(Float a, Float b) { return vmulq_f32(a, b); }
  static Float min(Float a, Float b) { return vbslq_f32(vcltq_f32(a, b), a, b); }
  static Float max(Float a, Float b) { return vbslq_f32(vcgtq_f32(a, b), a, b); }
  static Float abs(Float a) { return vabsq_f32(a); }
  static Float sqrt(Float a) { return vsqrtq_f32(a); }
  static float least(Float a) { return vminvq_f32(a); }

  static Int load(const std::uint32_t* from) { return vld1q_u32(from); }
  static void store(std::uint32_t* to, Int a) { vst1q_u32(to, a); }
  static Int all(std::uint32_t a) { return vdupq_n_u32(a); }
  static Int add(Int a, Int b) { return vaddq_u32(a, b); }
  static Int sub(Int a, Int b) { return vsubq_u32(a, b); }
  static Int min(Int a, Int b) {
    return vreinterpretq_u32_s32(vminq_s32(vreinterpretq_s32_u32(a), vreinterpretq_s32_u32(b)));
  }
  static Int half(Int a) { return vreinterpretq_u32_s32(vshrq_n_s32(vreinterpretq_s32_u32(a), 1)); }
  static Float to_float(Int a) { return vcvtq_f32_s32(vreinterpretq_s32_u32(a)); }
  static Int to_nearest(Float a) { return vreinterpretq_u32_s32(vcvtnq_s32_f32(a)); }

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
    return vaddq_u32(sums, vreinterpretq_u32_s32(vpaddq_s32(vpaddlq_s16(low), vpaddlq_s16(high))));
  }

  using Bytes = uint8x16_t;
  using Sums = uint32x4_t;
  static constexpr std::size_t kBytes = 16;
  static Bytes load_bytes(const std::uint8_t* from) { return vld1q_u8(from); }
  static Bytes load_last(const std::uint8_t* end, std::size_t count) {
    static constexpr std::uint8_t kPlaces[kBytes] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const auto first = static_cast<std::uint8_t>(kBytes - count);
    return vandq_u8(load_bytes(end - kBytes), vcgeq_u8(vld1q_u8(kPlaces), vdupq_n_u8(first)));
  }
  static Sums no_sums() { return vdupq_n_u32(0); }
  static Sums add_differences(Sums sums, Bytes a, Bytes b) {
    return vpadalq_u16(sums, vpaddlq_u8(vabdq_u8(a, b)));
  }
  static std::int32_t total(Sums sums) { return static_cast<std::int32_t>(vaddvq_u32(sums)); }

  /// Else GCC reads values from memory again for each use, or keeps copies there.
  template <typename Register>
  static void keep_in_register(Register& values) {
    asm("" : "+w"(values));
  }
};

}  // namespace vo::lanes
