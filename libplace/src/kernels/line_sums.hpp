#pragma once

#include <cstddef>
#include <cstdint>

/// The inner loops of the sequence search, on integers: sums wrap around, and differences of them are exact.
namespace place::kernels {

inline constexpr std::size_t kChunk = 32;  ///< columns processed together; rows are padded to a multiple

/// out[i] = before[i] + round((costs[i] - centre) * scale), i < count.
struct Accumulation {
  const float* costs;
  float centre, scale;
  const std::uint32_t* before;
  std::uint32_t* out;
  std::size_t count;
};

/// A run of a line through every column of a row: its sum at column c is last[c] - before[c].
struct RunEnds {
  const std::uint32_t* last;
  const std::uint32_t* before;
};

/// Lines through every column of a row: the sum of a line is the sum of its runs.
struct LineSums {
  const RunEnds* runs;          ///< of all lines, one after another
  const std::uint32_t* counts;  ///< runs of each line, at least one
  std::size_t lines;
};

struct LineKernels {
  void (*accumulate)(const Accumulation&);
  /// costs[c] = factor * the least sum, for the kChunk columns from `column` on; returns the least of them.
  float (*least)(const LineSums&, std::size_t column, float factor, float* costs);
  /// The same if every line and column has its own factor, and a term that is 0 or infinite: line i's are at
  /// [i * kChunk] of `factors` and `terms`.
  float (*least_weighted)(const LineSums&, std::size_t column, const float* factors, const float* terms,
                          float* costs);
};

/// The reference that the others must equal.
const LineKernels& scalar_line_kernels();

#if defined(__x86_64__)
/// Needs AVX2.
const LineKernels& avx2_line_kernels();
/// Needs AVX-512 F.
const LineKernels& avx512_line_kernels();
#endif

/// The fastest that this processor supports.
const LineKernels& line_kernels();

}  // namespace place::kernels
