#include "kernels/dot_product.hpp"

#include "kernels/dot_product_tiles.hpp"
#include "lanes/plain.hpp"

#include <algorithm>
#include <cstring>

namespace place::kernels {
namespace {

/// Writes `rows` interleaved: kGroup values of each at a time, as `Value`. A few groups of all rows at a
/// time, whose destinations are close together.
template <class Value, std::size_t kGroup>
void interleave(const SignedRows& rows, std::size_t lanes, int offset, std::uint8_t* packed) {
  static_assert(kGroup * sizeof(Value) == sizeof(std::uint32_t));
  constexpr std::size_t kTogether = 16 * kGroup;
  const std::size_t step = lanes * sizeof(std::uint32_t);
  for (std::size_t begin = 0; begin < rows.size; begin += kTogether) {
    const std::size_t end = std::min(rows.size, begin + kTogether);
    for (std::size_t i = 0; i < lanes; ++i) {
      Value values[kTogether];
      if (i < rows.count) {
        const std::int8_t* row = rows.values + i * rows.size;
        for (std::size_t k = begin; k < end; ++k) values[k - begin] = static_cast<Value>(row[k] + offset);
      } else {
        std::fill_n(values, kTogether, static_cast<Value>(offset));
      }
      std::uint8_t* to = packed + begin / kGroup * step + i * sizeof(std::uint32_t);
      for (std::size_t k = 0; k < end - begin; k += kGroup, to += step)
        std::memcpy(to, values + k, sizeof(std::uint32_t));
    }
  }
}

void pack(const vo::lanes::Packing& packing, const SignedRows& rows, std::size_t lanes, int offset,
          std::uint8_t* packed) {
  if (packing.group == 4) return interleave<std::uint8_t, 4>(rows, lanes, offset, packed);
  interleave<std::int16_t, 2>(rows, lanes, offset, packed);
}

}  // namespace

void pack_left(const vo::lanes::Packing& packing, const SignedRows& rows, std::size_t lanes,
               std::uint8_t* packed) {
  pack(packing, rows, lanes, packing.left_offset, packed);
}

void pack_right(const vo::lanes::Packing& packing, const SignedRows& rows, std::size_t lanes,
                std::uint8_t* packed) {
  pack(packing, rows, lanes, 0, packed);
}

const DotKernels& scalar_dot_kernels() {
  return kDotTable<vo::lanes::Scalar, 1, 1>;
}

const DotKernels& dot_kernels() {
#if defined(__x86_64__)
  static const DotKernels& fastest = []() -> const DotKernels& {
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"))
      return __builtin_cpu_supports("avx512vnni") ? vnni_dot_kernels() : avx512_dot_kernels();
    return __builtin_cpu_supports("avx2") ? avx2_dot_kernels() : scalar_dot_kernels();
  }();
  return fastest;
#elif defined(__aarch64__)
  return neon_dot_kernels();
#else
  return scalar_dot_kernels();
#endif
}

}  // namespace place::kernels
