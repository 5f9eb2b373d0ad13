#pragma once

#include "vo/image/image_stack.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vo {

/// A frame compared with a later one.
struct Comparison {
  std::uint32_t frames = 0;  ///< how many frames later; 0 if there was none to compare with
  float seconds = 0;         ///< how much later
  float error = 0;           ///< mean absolute difference, in standard deviations of a patch

  [[nodiscard]] bool made() const { return frames > 0; }
};

/// Image alignment errors of a walk (SSS 3.1): how much frames differ from those some time later.
struct AlignmentErrors {
  /// `by_span[k][i]` compares frame i with the frame nearest to k + 1 spans after it, unless that is more
  /// than half a span away. One value per frame and span.
  std::vector<std::vector<Comparison>> by_span;

  [[nodiscard]] std::size_t spans() const { return by_span.size(); }
  [[nodiscard]] std::size_t frames() const { return by_span.empty() ? 0 : by_span[0].size(); }
};

/// SSS 3.1 compares frames 0..10 apart, at 25 to 30 frames/s: the time between two of them.
inline constexpr double kAlignmentSpan_s = 0.04;

/// Settings of `alignment_errors` and `high_error_windows`.
struct AlignmentErrorOptions {
  std::size_t spans = 10;      ///< times between frames that are compared: 0.04 s to 0.4 s
  double smoothing_s = 5;      ///< seconds, sliding window over the per-frame error (SSS Fig. 10)
  double high_error_mads = 3;  ///< a window this many median absolute deviations above the median is left out
};

/// Mean absolute difference of two patch-normalised images (bytes), in standard deviations of a patch. Exact
/// integer sums. Throws `std::invalid_argument` unless they have the same size and are not empty.
double alignment_error(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

/// SSS Eq. 1 before averaging, over spans of time where SSS uses numbers of frames, so that errors do not
/// depend on the frame rate, even if it changes. A span is `kAlignmentSpan_s`, or half the median time
/// between frames in a recording so slow that this is more.
///
/// `normalised`: bytes of `patch_normalise`, in order of time; `time_s`: of each, strictly increasing. Exact
/// integer sums. Throws `std::invalid_argument` for no spans or another number of times. O(frames * spans *
/// pixels), in parallel over frames.
AlignmentErrors alignment_errors(const ImageStack& normalised, std::span<const double> time_s,
                                 const AlignmentErrorOptions& options = {});

/// The mean error at each span (SSS Eq. 1, Fig. 2), over the frames that count.
struct MeanErrors {
  std::vector<double> seconds;  ///< 0, then the mean time between the frames compared, increasing
  std::vector<double> error;    ///< 0, then the mean error
};

/// Starts with 0 at 0 s. `excluded`: one flag per frame, or empty for none. Spans without a comparison are
/// left out.
MeanErrors mean_errors(const AlignmentErrors& errors, const std::vector<bool>& excluded = {});

/// The error along a walk, which shows windows of high error (SSS 6, Fig. 10).
struct ErrorCourse {
  std::vector<double> relative;  ///< each frame's error, as a multiple of the usual error at its spans
  std::vector<double> smoothed;  ///< the same over a sliding window of time; 0 at frames that are excluded
  double limit = 0;              ///< smoothed errors above it are high; infinite if no frame counts
};

/// The error of each frame, as a multiple of the usual error at its spans (a frame that was not compared has
/// its neighbour's), smoothed over time, and the walk's median + high_error_mads * MAD. Frames `excluded`
/// (one flag per frame, or none) are ignored. `time_s`: one per frame, increasing. O(frames * spans).
ErrorCourse error_course(const AlignmentErrors& errors, std::span<const double> time_s,
                         const std::vector<bool>& excluded = {}, const AlignmentErrorOptions& options = {});

/// The frames in windows of high error: fairly large turns, abrupt changes of scene, fast camera motion (SSS
/// 6, Fig. 10): where the smoothed error of `error_course` is above its limit. Frames `excluded` are never
/// flagged. Returns one flag per frame.
std::vector<bool> high_error_windows(const AlignmentErrors& errors, std::span<const double> time_s,
                                     const std::vector<bool>& excluded = {},
                                     const AlignmentErrorOptions& options = {});

}  // namespace vo
