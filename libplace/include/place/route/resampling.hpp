#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// The reference unit of dynamic frame sampling, u = n (mean + 2 sd) of the displacements (SSS Eq. 4), over
/// 1/25 s: SSS has one value for each frame, at 25 to 30 frames/s, and so another unit at another frame rate.
/// The mean is over time, of the frames at which the walker moves: a walk has the same unit however long its
/// stands are.
///
/// `displacement`: one per frame, since the frame before it, 0 where the walker stands; the first is not
/// used. `time_s`: one per frame, increasing. `n` > 0: larger means fewer keyframes. Throws
/// `std::invalid_argument` for fewer than two frames, another number of times, or n <= 0. Returns 0 for a
/// walk without motion. O(n).
double sampling_unit(std::span<const double> displacement, std::span<const double> time_s, double n);

/// Frames that lie `unit` apart in travelled displacement (SSS 3.3): the first frame, and for each whole
/// multiple of `unit` the frame nearest to it. A walker who stands still adds none; one who covers several
/// units between two frames adds one, not copies. At each frame of `begins` (increasing), before which nobody
/// knows how far the walker went, it begins anew. Strictly increasing. Throws `std::invalid_argument` unless
/// unit > 0 and `begins` are frames of the walk.
std::vector<std::size_t> resample(std::span<const double> displacement, double unit,
                                  std::span<const std::size_t> begins = {});

/// Every k-th frame from the first: the fixed sampling of the paper's vanilla. Throws `std::invalid_argument`
/// if k is 0.
std::vector<std::size_t> every_kth(std::size_t frames, std::size_t k);

}  // namespace place
