#pragma once

#include <cstddef>
#include <cstdint>

/// The inner loops of SURF and of its matching, for each instruction set. All sets give the same bits.
namespace vo::kernels {

inline constexpr int kLanes =
    8;  ///< every buffer may be read and written up to this many values past its use

/// One row of responses of one box filter.
struct HessianRow {
  const std::uint32_t* integral;  ///< the integral image's row of the filters' centres
  std::ptrdiff_t stride;          ///< from one of its rows to the next
  int lobe_px;                    ///< a third of the filter's side; odd
  int begin, end;                 ///< columns of the centres
  float scale;                    ///< factor of each second derivative
  std::uint32_t* scratch;         ///< 3 * scratch_stride values
  std::ptrdiff_t scratch_stride;
  float* out;  ///< out[x]: determinant at column x
};

/// One row of one interval, in the middle of its neighbours: the same row of the interval below and above,
/// and for each interval the row before and after.
struct MaximaRow {
  const float* rows[3][3];  ///< [interval][row]
  int begin, end;           ///< columns
  float threshold;          ///< least response
};

/// A smoothed image to be sampled.
struct Raster {
  const std::uint16_t* values;
  int stride;
  float last_column, last_row;  ///< of the image; one column and one row more may be read
};

/// A square grid of samples: point (row, column) is at centre + (column - middle) u + (row - middle) v.
struct Grid {
  float x, y;    ///< of the centre
  float ux, uy;  ///< from one column to the next
  float vx, vy;  ///< from one row to the next
};

inline constexpr int kOrientationRadius = 6;     ///< samples from the centre to the rim
inline constexpr int kOrientationHarmonics = 8;  ///< moments of the directions
inline constexpr int kOrientationRows = 13;      ///< of gradients; one more sample on each side
inline constexpr int kOrientationColumns = 16;   ///< 13 and padding
inline constexpr int kDescriptorSamples = 20;    ///< gradients along a side
inline constexpr int kDescriptorColumns = 24;    ///< 20 and padding
inline constexpr int kDescriptorCells = 4;       ///< subregions along a side

/// weights[r][c] of the gradients about a point; 0 in the padding.
struct OrientationWeights {
  float values[kOrientationRows][kOrientationColumns];
};

/// moments[2 m - 2], moments[2 m - 1]: sum of weight * length * (cos, sin)(m * direction) of the gradients,
/// m = 1 .. kOrientationHarmonics.
struct OrientationMoments {
  float values[2 * kOrientationHarmonics];
};

/// weights[i][k] of gradient k in subregion i, along a row as along a column; 0 in the padding.
struct DescriptorWeights {
  float values[kDescriptorCells][kDescriptorColumns];
};

/// Points and their descriptors, 8 at a time.
struct PointBlock {
  const float* values;  ///< queries: row by row; references: value k of reference j at [8 k + j]
  const float* norms;   ///< squared lengths; infinite for what fills up the last block
  const float* x_px;
  const float* y_px;
};

/// Squared distances of 8 queries to 8 references, infinite between points further apart than `reach_px`.
struct DistanceBlock {
  PointBlock queries, references;
  std::size_t size;  ///< of a descriptor
  float squared_reach_px;
  const float* limits;   ///< per query, the distance up to which it cares
  float* minima;         ///< per reference, the least distance so far
  float (*out)[kLanes];  ///< [query][reference]
  unsigned* within;      ///< per query, bit j: reference j is within its limit
};

struct Kernels {
  void (*hessian_row)(const HessianRow&);
  /// Columns of maxima in increasing order to `columns`; returns how many. Of equal neighbours the first in
  /// order of interval, row, column is the maximum.
  int (*maxima_row)(const MaximaRow&, int* columns);
  void (*orientation_moments)(const Raster&, const Grid&, const OrientationWeights&, OrientationMoments&);
  /// The 64 or 128 sums, not normalised.
  void (*descriptor_sums)(const Raster&, const Grid&, const DescriptorWeights&, bool extended, float* out);
  void (*squared_distances)(const DistanceBlock&);
};

/// Those that the others must equal.
const Kernels& scalar_kernels();

#if defined(__x86_64__)
/// Needs AVX2.
const Kernels& avx2_kernels();
#endif

/// The fastest of them that this processor runs.
const Kernels& kernels();

}  // namespace vo::kernels
