#pragma once

#include "vo/motion/alignment_error.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vo {

/// The learned relation of alignment error and time between frames (SSS 3.2, Fig. 3, where it is a number of
/// frames): knots strictly increasing in both, from (0, 0), joined by a second-order spline. With a single
/// knot nothing was learned.
struct MotionModel {
  std::vector<double> error;       ///< standard deviations of a patch
  std::vector<double> separation;  ///< seconds of the walk it was learned on, at its mean speed; or what
                                   ///< displacements it was learned from

  [[nodiscard]] bool learned() const { return error.size() >= 2; }
};

/// Settings of `estimate_motion`.
struct MotionModelOptions {
  /// Spans (`kAlignmentSpan_s`) between frames whose estimates are compared for each frame, 1 .. this. 1 is
  /// SSS Eq. 3 to the letter at 25 frames/s. Image bounce and sway add to the error over short spans as
  /// motion does, but do not grow with the span.
  int separations = 5;
  /// Times the mean speed of the walk: what is faster is a turn or a jolt, not walking. Infinity leaves it
  /// out.
  double max_speed = 2;
  /// Seconds of the walk, up to the frame, that its model is learned from (`local temporal window`, SSS 3); 0
  /// learns one model from the whole walk. A local model equalises speeds across windows, so it must span
  /// slow and fast parts.
  double local_window_s = 0;
};

/// Learns the model from the mean error over each span (SSS 3.2), on the part from 0 that strictly increases;
/// what lies beyond has saturated and tells nothing.
MotionModel learn_motion_model(const MeanErrors& means);

/// Learns alignment error against displacement that is known from elsewhere (SSS 3.5: visual odometry)
/// instead of time. Pairs of frames over all spans, all frames between them known, are put in order of their
/// displacement and averaged in `kMotionModelBins` bins of equally many; the part that strictly increases is
/// kept.
///
/// `displacement`: of each frame since the one before; `known`: one flag per frame, true where it counts.
/// With fewer than ten pairs to a bin nothing is learned. O(frames * spans * log).
MotionModel learn_motion_model(const AlignmentErrors& errors, std::span<const double> displacement,
                               const std::vector<bool>& known);
inline constexpr std::size_t kMotionModelBins = 12;

/// The separation that belongs to each error: the spline, clamped to the knots' range at both ends (SSS Eq.
/// 3). All 0 for a model without knots beyond the first. Non-decreasing in the error: where the quadratic
/// would overshoot, straight pieces take its place.
std::vector<double> separation_of(const MotionModel& model, std::span<const float> errors);

/// Displacement of each frame since the one before it, in the model's unit; 0 for the first (SSS 3.2, 3.5).
/// None where nothing was compared over it, as over a jump of the clock.
///
/// For every span k, F(e_k) / seconds is an estimate of the speed over it (SSS Eq. 3 has neighbouring frames
/// only); a frame's displacement is the least, over k, of the mean estimate of the spans that contain it,
/// times the time since the frame before. Motion adds to the error over every span alike, bounce does so only
/// over short ones, hence the least. Spans whose error lies on the clamped part of the model only say "at
/// least" and are left out but for the shortest. Nothing moves faster than `max_speed`, in the model's unit
/// a second. All 0 for a model that learned nothing. `time_s`: one per frame, increasing. Throws
/// `std::invalid_argument` unless `separations` is in 1 .. the errors' spans, there is one time per frame,
/// and max_speed > 0. O(frames * separations^2).
std::vector<std::optional<double>> apply_motion_model(const AlignmentErrors& errors, const MotionModel& model,
                                                      std::span<const double> time_s, int separations,
                                                      double max_speed);

/// The same, in seconds at mean speed, by the model that the walk itself gives, or by one for each local
/// window. Where a gap of the clock leaves nothing to compare, it is 0.
///
/// `excluded`: frames left out of learning, as from `high_error_windows` and `standing_steps`, or empty.
std::vector<double> estimate_motion(const AlignmentErrors& errors, const std::vector<bool>& excluded,
                                    std::span<const double> time_s, const MotionModelOptions& options = {});

}  // namespace vo
