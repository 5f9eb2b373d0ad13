#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// The reference unit of dynamic frame sampling, u = n (mean + 2 sd) of the displacements (SSS Eq. 4), over
/// 1/25 s: SSS has one value per frame, at 25 to 30 frames/s, so its unit depends on the frame rate. The mean
/// is over time, over frames at which the walker moves: the unit does not depend on the length of pauses.
///
/// `displacement`: one per frame, since the frame before it, 0 where the walker is still; the first is not
/// used. `time_s`: one per frame, increasing. `n` > 0: larger means fewer keyframes. Throws
/// `std::invalid_argument` for fewer than two frames, another number of times, or n <= 0. Returns 0 for a
/// walk without motion. O(n).
double sampling_unit(std::span<const double> displacement, std::span<const double> time_s, double n);

/// Frames that are `unit` apart in travelled displacement (SSS 3.3): the first frame, and for each whole
/// multiple of `unit` the frame nearest to it. A walker who is still adds none; one who covers several units
/// between two frames adds one, not copies. Sampling restarts at each frame of `begins` (increasing), before
/// which the distance is unknown. Strictly increasing. Throws `std::invalid_argument` unless unit > 0 and
/// `begins` are frames of the walk.
std::vector<std::size_t> resample(std::span<const double> displacement, double unit,
                                  std::span<const std::size_t> begins = {});

/// Every k-th frame from the first: the fixed sampling of the paper's "vanilla". Throws
/// `std::invalid_argument` if k is 0.
std::vector<std::size_t> every_kth(std::size_t frames, std::size_t k);

}  // namespace place
