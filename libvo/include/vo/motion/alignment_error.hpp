#pragma once

#include "vo/image/image_stack.hpp"

#include <span>
#include <vector>

namespace vo {

/// Image alignment errors of a walk (SSS 3.1): how unlike frames of the walk are to those s frames on.
struct AlignmentErrors {
  /// `by_separation[s][i]` is the mean absolute difference of frames i and i + s, in standard deviations of a
  /// patch, for s = 0 .. max separation and every i for which frame i + s exists.
  std::vector<std::vector<float>> by_separation;

  [[nodiscard]] int max_separation() const { return static_cast<int>(by_separation.size()) - 1; }
  [[nodiscard]] std::size_t frames() const { return by_separation.empty() ? 0 : by_separation[0].size(); }
};

/// Settings of `alignment_errors` and `high_error_windows`.
struct AlignmentErrorOptions {
  int max_separation = 10;     ///< frames (SSS 3.1: 0..10 at 25-30 frames/s)
  double smoothing_s = 5;      ///< seconds, sliding window over the per-frame error (SSS Fig. 10)
  double high_error_mads = 3;  ///< a window this many median absolute deviations above the median is left out
};

/// Mean absolute difference of two patch-normalised images (bytes), in standard deviations of a patch. Exact
/// integer sums. Throws `std::invalid_argument` unless they are of one size and not empty.
double alignment_error(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

/// SSS Eq. 1 before its average. `normalised`: bytes of `patch_normalise`, in order of time. Exact integer
/// sums. Throws `std::invalid_argument` if max_separation < 1. O(frames * separations * pixels), in parallel
/// over frames.
AlignmentErrors alignment_errors(const ImageStack& normalised, const AlignmentErrorOptions& options = {});

/// The frames in windows of high error: fairly large turns, abrupt changes of scene, speedy camera motion
/// (SSS 6, Fig. 10). The error of a frame is averaged over all separations, smoothed over time, and compared
/// with the walk's median + high_error_mads * MAD. `time_s`: one per frame, increasing. Returns one flag per
/// frame.
std::vector<bool> high_error_windows(const AlignmentErrors& errors, std::span<const double> time_s,
                                     const AlignmentErrorOptions& options = {});

/// Mean error at each separation over the frames not `excluded` (SSS Eq. 1, Fig. 2), starting with 0 at
/// separation 0. `excluded`: one flag per frame, or empty for none. A separation without a frame left repeats
/// the one before.
std::vector<double> mean_error_by_separation(const AlignmentErrors& errors,
                                             const std::vector<bool>& excluded = {});

}  // namespace vo
