#pragma once

#include <cstddef>
#include <cstdint>

namespace place::kernels {

/// Images of `size` bytes, one after another.
struct ByteImages {
  const std::uint8_t* bytes;
  std::size_t count;
};

/// sums[i * stride + j] = sum over k < size of |queries[i * size + k] - references[j * size + k]|. Exact.
/// `size` < 2^24, so that the sum fits 32 bits; stride >= references.count. A thread streams the references
/// past the queries, which had best fit half its second-level cache.
using AbsoluteDifferenceKernel = void (*)(ByteImages queries, ByteImages references, std::size_t size,
                                          std::uint32_t* sums, std::size_t stride);

/// The plain loop that the others must equal.
void absolute_difference_scalar(ByteImages queries, ByteImages references, std::size_t size,
                                std::uint32_t* sums, std::size_t stride);

#if defined(__x86_64__)
/// Needs AVX2.
void absolute_difference_avx2(ByteImages queries, ByteImages references, std::size_t size,
                              std::uint32_t* sums, std::size_t stride);
/// Needs AVX-512 F and BW.
void absolute_difference_avx512(ByteImages queries, ByteImages references, std::size_t size,
                                std::uint32_t* sums, std::size_t stride);
#elif defined(__aarch64__)
void absolute_difference_neon(ByteImages queries, ByteImages references, std::size_t size,
                              std::uint32_t* sums, std::size_t stride);
#endif

/// The fastest of them that this processor runs.
AbsoluteDifferenceKernel absolute_difference();

}  // namespace place::kernels
