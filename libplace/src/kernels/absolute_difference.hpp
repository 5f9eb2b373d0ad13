#pragma once

#include <cstddef>
#include <cstdint>

namespace place::kernels {

/// Images, one after another.
struct ByteImages {
  const std::uint8_t* bytes;
  std::size_t count;
};

/// The compared part of images: the first `bytes` of each, with `stride` bytes from one image to the next.
struct ImageSize {
  std::size_t bytes;
  std::size_t stride;
};

/// The output, query by query: scale * sum for query i and reference j goes to values[i * stride + j].
struct ScaledSums {
  float scale;
  float* values;
  std::size_t stride;
};

/// sums of |queries[i * stride + k] - references[j * stride + k]| over k < bytes. Exact integers until the
/// two roundings of `float(sum) * scale`. `bytes` < 2^23, so that a sum fits 31 bits; stride >=
/// references.count. A thread streams the references past the queries, which should fit half its second-level
/// cache; images aligned to cache lines are read at up to twice the speed.
using AbsoluteDifferenceKernel = void (*)(ByteImages queries, ByteImages references, ImageSize size,
                                          const ScaledSums& sums);

/// The plain loop that the others must equal.
void absolute_difference_scalar(ByteImages queries, ByteImages references, ImageSize size,
                                const ScaledSums& sums);

#if defined(__x86_64__)
/// Needs AVX2.
void absolute_difference_avx2(ByteImages queries, ByteImages references, ImageSize size,
                              const ScaledSums& sums);
/// Needs AVX-512 F and BW.
void absolute_difference_avx512(ByteImages queries, ByteImages references, ImageSize size,
                                const ScaledSums& sums);
#elif defined(__aarch64__)
void absolute_difference_neon(ByteImages queries, ByteImages references, ImageSize size,
                              const ScaledSums& sums);
#endif

/// The fastest that this processor supports.
AbsoluteDifferenceKernel absolute_difference();

}  // namespace place::kernels
