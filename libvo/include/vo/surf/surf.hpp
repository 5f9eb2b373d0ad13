#pragma once

#include "vo/surf/features.hpp"
#include "vo/surf/hessian_detector.hpp"

#include <opencv2/core/mat.hpp>

namespace vo {

/// Settings of `detect_surf`.
struct SurfOptions {
  HessianOptions detector;
  bool upright = false;   ///< no orientations (Bay et al. 2008, U-SURF): for images that are not turned
  bool extended = false;  ///< descriptors of 128 values instead of 64
};

/// Interest points with orientations and descriptors: Bay, Ess, Tuytelaars, Van Gool, "Speeded-Up Robust
/// Features (SURF)", 2008. The stages say where they leave the paper.
///
/// `grey`: 8 bit, one channel, at most 2^24 pixels, else `std::invalid_argument`, as for invalid options. An
/// empty or constant image, or one too small for the filters, has no points. Points are the strongest first.
/// The same bytes for any number of threads. libvo/README.md has times and figures of quality.
Features detect_surf(const cv::Mat& grey, const SurfOptions& options = {});

}  // namespace vo
