#pragma once

#include "vo/surf/features.hpp"
#include "vo/surf/smooth_pyramid.hpp"

#include <span>

namespace vo {

/// Describes the neighbourhood of a point by 64 or 128 numbers (Bay et al. 2008, section 4.2): a
/// square of 20 scales, turned by the point's orientation, of 4 x 4 subregions; of each the sums of the Haar
/// wavelets dx, dy, |dx|, |dy|, by rows of subregions. Extended: dx, |dx| apart for dy < 0 and dy >= 0, and
/// the other way round.
///
/// Deviations: the wavelets are taken from the smoothed image along the turned axes instead of along the
/// image's, without rounding to pixels; subregions overlap by 2 scales, each with a Gaussian of its own
/// (Agrawal, Konolige and Blas 2008, section 3.3), so that a sample near a border does not jump over it.
///
/// `out`: 64 values, or 128 if extended, else `std::invalid_argument`; of unit length, or all 0 where the
/// neighbourhood is of one grey. Outside the image it is as on its rim. About 1 us.
void describe(const SmoothPyramid& pyramid, const Feature& point, std::span<float> out);

}  // namespace vo
