#pragma once

#include <cstddef>
#include <cstdint>

namespace place::kernels {

/// sums[j] = sum over k < size of |query[k] - references[j * size + k]|, j < count. Exact. `size` < 2^24, so
/// that the sum fits 32 bits.
using AbsoluteDifferenceKernel = void (*)(const std::uint8_t* query, const std::uint8_t* references,
                                          std::size_t count, std::size_t size, std::uint32_t* sums);

/// The plain loop that the others must equal.
void absolute_difference_scalar(const std::uint8_t* query, const std::uint8_t* references, std::size_t count,
                                std::size_t size, std::uint32_t* sums);

#if defined(__x86_64__)
/// Needs AVX2.
void absolute_difference_avx2(const std::uint8_t* query, const std::uint8_t* references, std::size_t count,
                              std::size_t size, std::uint32_t* sums);
#endif

/// The fastest of them that this processor runs.
AbsoluteDifferenceKernel absolute_difference();

}  // namespace place::kernels
