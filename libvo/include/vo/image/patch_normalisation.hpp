#pragma once

#include "vo/image/image_stack.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace vo {

/// What the mean and the deviation of a pixel are taken over.
enum class PatchShape {
  kGrid,    ///< the cell of a fixed grid the pixel lies in (OpenSeqSLAM)
  kWindow,  ///< the window centred at the pixel, cut at the border (SSS Eq. 2: "the patch centered at k")
};

/// Settings of `patch_normalise`.
struct PatchNormalisationOptions {
  int patch_px = 8;  ///< side of a cell; a window is the next odd number wide (OpenSeqSLAM: 8)
  PatchShape shape = PatchShape::kGrid;  ///< see PatchShape
  double min_deviation = 1;  ///< grey levels; a flatter patch is divided by this, so noise is not blown up
  /// The same as a share of the median deviation of the image's grid cells, so that it follows exposure and
  /// contrast and a few bright lamps do not raise it; the larger of both floors holds. 0 leaves it out.
  double min_contrast = 1.25;
};

/// Bytes stand for standard deviations from the patch mean: 128 is the mean (and any pixel of a patch without
/// texture), one deviation is 16 steps. No pixel of an 8x8 patch can be further than sqrt(63) = 7.94
/// deviations from its mean, which just fits; beyond, values are clamped.
inline constexpr int kNeutralByte = 128;
inline constexpr double kStepsPerDeviation = 16;

/// Patch normalisation, SSS Eq. 2: I' = (I - mean_p) / max(sd_p, floor), with population deviations and
/// floor = max(min_deviation, min_contrast * median sd of the grid's cells). SSS has no floor: a patch of sky
/// or plain wall then becomes noise of full contrast, which counts in every difference as much as a patch
/// with a window in it.
///
/// `image`: width * height grey bytes, row-major. `out`: as many values, in deviations; a patch without
/// texture is all 0. Throws `std::invalid_argument` if sizes disagree, patch_px < 2, or (kGrid) a side is no
/// multiple of patch_px. O(pixels) for either shape.
void patch_normalise(std::span<const std::uint8_t> image, int width, int height,
                     const PatchNormalisationOptions& options, std::span<float> out);

/// The texture of each image of a stack: the median deviation of the cells of its grid, grey levels. Throws
/// `std::invalid_argument` if patch_px < 2. O(pixels), in parallel over the images.
std::vector<double> patch_contrast(const ImageStack& images, int patch_px);

/// `patch_normalise` for every image of a stack, rounded to bytes (see kStepsPerDeviation). Runs in parallel
/// over the images.
ImageStack patch_normalise(const ImageStack& images, const PatchNormalisationOptions& options);

}  // namespace vo
