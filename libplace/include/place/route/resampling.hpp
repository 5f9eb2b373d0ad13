#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// The reference unit of dynamic frame sampling, u = n (mean + 2 sd) of the displacements (SSS Eq. 4).
///
/// `displacement`: one per frame, since the frame before it; the first is not used. `n` > 0: larger means
/// fewer keyframes. Throws `std::invalid_argument` for fewer than two frames or n <= 0. Returns 0 for a walk
/// without motion.
double sampling_unit(std::span<const double> displacement, double n);

/// Frames that lie `unit` apart in travelled displacement (SSS 3.3): the first frame, and for each whole
/// multiple of `unit` the frame nearest to it. A walker who stands still adds none; one who covers several
/// units between two frames adds one, not copies. Strictly increasing. Throws `std::invalid_argument` unless
/// unit > 0.
std::vector<std::size_t> resample(std::span<const double> displacement, double unit);

/// Every k-th frame from the first: the fixed sampling of the paper's vanilla. Throws `std::invalid_argument`
/// if k is 0.
std::vector<std::size_t> every_kth(std::size_t frames, std::size_t k);

}  // namespace place
