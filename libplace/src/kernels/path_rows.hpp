#pragma once

#include <cstddef>

/// The inner loops of the path search. Every instruction set gives the same bytes: sums are kept in kLanes
/// parts for any register width, and no operations are fused.
namespace place::kernels {

inline constexpr std::size_t kLanes = 16;

/// The sum and the maximum of a chunk.
struct ChunkTotals {
  double sum;
  float most;
};

struct PathKernels {
  /// out[i] = 2^(slope * (even - cost)), costs clamped to +-furthest; relative error 4e-6.
  void (*likelihoods)(const float* costs, std::size_t count, float even, float slope, float furthest,
                      float* out);
  /// to[i] = floor + sum over k < tap_count of taps[k] * from[i + k].
  void (*convolve)(const float* from, std::size_t count, const float* taps, std::size_t tap_count,
                   float floor, float* to);
  /// out[i] = a[i] * b[i]; `out` may be `a`. Returns the sum.
  double (*multiply)(const float* a, const float* b, std::size_t count, float* out);
  /// The same, and the maximum; factors are not negative.
  ChunkTotals (*multiply_chunk)(const float* a, const float* b, std::size_t count, float* out);
};

/// For any processor.
const PathKernels& plain_path_kernels();

#if defined(__x86_64__)
/// Needs AVX2.
const PathKernels& avx2_path_kernels();
#endif

/// The fastest that this processor supports.
const PathKernels& path_kernels();

}  // namespace place::kernels
