#pragma once

#include "vo/surf/features.hpp"
#include "vo/surf/integral_image.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace vo {

/// Which interest points are found.
struct HessianOptions {
  float threshold =
      1;  ///< least determinant of the Hessian, grey levels^2, > 0; night and blank walls need a low one
  std::size_t max_points = 600;  ///< the strongest are kept; 0: all
  int octaves = 4;               ///< doublings of scale, 1 to 8 (Bay: 3 to 4)
  int intervals = 4;             ///< filters per octave, 3 to 6 (Bay: 4)
  int initial_step_px = 1;       ///< sampling step of the first octave, 1, 2 or 4; its filters grow with it

  float rim_scales = 7;  ///< least distance from the rim of the image, scales; 7 is what `orientation` reads

  /// True if every field is in its range; else says in `*error` which is not.
  [[nodiscard]] bool is_valid(std::string* error) const;
};

/// Blobs where the determinant of the Hessian is greatest in place and scale: the Fast-Hessian detector of
/// Bay et al. 2008, section 3. The second derivatives are box filters of side L = 9, 15, 21, 27 on the
/// integral image, normalised by L^2; maxima of 3 x 3 x 3 are refined by a quadratic (Brown and Lowe 2002).
///
/// One deviation: octave o is the first octave on every 2^o-th row and column of the integral image, which is
/// that of the picture shrunk 2^o times by box averages. Its filters have sides 2^o L (18, 30, 42, 54 in the
/// second; Bay's are 15, 27, 39, 51) and the grid is as wide as the paper's. So octaves differ only in scale,
/// adjoin without overlap (Bay's count the scales between them twice), and are computed by one loop.
///
/// Strength is response * sqrt(scale), where the paper takes the response: of two blobs of equal contrast the
/// larger survives blur better, because it averages over more pixels (libvo/README.md has the figures).
///
/// Returns points of which position, scale, response and laplacian are set, the strongest first (then by row,
/// column and scale), which lie in the image far enough from its rim for the filter above theirs. An image
/// smaller than the filters or constant has none. Throws `std::invalid_argument` if options are invalid.
/// O(4/3 * pixels * intervals) for any number of octaves, in parallel.
std::vector<Feature> detect_blobs(const IntegralImage& integral, const HessianOptions& options = {});

}  // namespace vo
