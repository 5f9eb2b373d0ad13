#pragma once

#include "vo/surf/features.hpp"
#include "vo/surf/smooth_pyramid.hpp"

namespace vo {

/// The dominant direction of a point's neighbourhood: that of the window of directions in which its
/// gradients, weighted by their length and a Gaussian about the point, sum to most (Bay et al. 2008,
/// section 4.1). Step detection reads the walker's sway from it, so it must turn exactly as the image does;
/// the paper asks only for repeatability. Hence these deviations:
/// - Gradients come from the smoothed image, sampled between pixels, by a difference whose direction is right
///   to fourth order; Haar wavelets of 4 scales are off by up to some 5 degrees at 20 degrees to the axes,
///   and their rounding to pixels adds noise.
/// - The window has soft edges and slides continuously: a Gaussian whose direction histogram is a Fourier
///   series of 8 terms, the peak of which is found to rounding error.
///
/// Reads the image up to 7 scales away, and repeats its rim outside. Returns radians in (-pi, pi], from +x
/// towards +y; 0 where there is no gradient. About 0.7 us.
float orientation(const SmoothPyramid& pyramid, const Feature& point);

}  // namespace vo
