#pragma once

#include "vo/motion/alignment_error.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vo {

/// The learned relation of alignment error and time between frames (SSS 3.2, Fig. 3, in numbers of frames):
/// knots from (0, 0), strictly increasing in both, joined by a second-order spline. With a single knot,
/// nothing was learned.
struct MotionModel {
  std::vector<double> error;       ///< standard deviations of a patch
  std::vector<double> separation;  ///< seconds of the walk it was learned on, at its mean speed; or the unit
                                   ///< of the displacements it was learned from

  [[nodiscard]] bool learned() const { return error.size() >= 2; }
};

/// Settings of `estimate_motion`.
struct MotionModelOptions {
  /// Spans (`kAlignmentSpan_s`) between frames whose estimates are compared for each frame, 1 .. this. At 25
  /// frames/s, 1 is exactly SSS Eq. 3. Image bounce and sway add to the error over short spans as motion
  /// does, but do not grow with the span.
  int separations = 5;
  /// Times the mean speed of the walk: anything faster is a turn or a jolt, not walking. Infinity disables
  /// it.
  double max_speed = 2;
  /// Seconds of the walk, up to the frame, that its model is learned from (`local temporal window`, SSS 3); 0
  /// learns one model from the whole walk. A local model equalises speeds across windows, so it must span
  /// slow and fast parts.
  double local_window_s = 0;
};

/// Learns the model from the mean error over each span (SSS 3.2), on the part from 0 that strictly increases;
/// beyond it the error has saturated.
MotionModel learn_motion_model(const MeanErrors& means);

/// Learns alignment error against displacement known from elsewhere (SSS 3.5: visual odometry) instead of
/// time. Pairs of frames over all spans, with all frames between them known, are sorted by displacement and
/// averaged in `kMotionModelBins` bins of equal size; the part that strictly increases is kept.
///
/// `displacement`: of each frame since the one before; `known`: one flag per frame, true where it counts.
/// Learns nothing from fewer than ten pairs per bin. O(frames * spans * log).
MotionModel learn_motion_model(const AlignmentErrors& errors, std::span<const double> displacement,
                               const std::vector<bool>& known);
inline constexpr std::size_t kMotionModelBins = 12;

/// The separation for an error: the spline, clamped to the knots' range at both ends (SSS Eq. 3). 0 for a
/// model with no knots beyond the first. Non-decreasing in the error: where the quadratic would overshoot,
/// straight pieces replace it. Made once, from a few thousand points of the spline, for any number of errors.
class SeparationCurve {
 public:
  SeparationCurve() = default;  ///< of a model that learned nothing
  explicit SeparationCurve(const MotionModel& model);

  [[nodiscard]] double operator()(double error) const;

 private:
  double step_ = 0;
  std::vector<double> value_;  ///< at multiples of the step
};

/// The same of each error.
std::vector<double> separation_of(const MotionModel& model, std::span<const float> errors);

/// Displacement of each frame since the one before it, in the model's unit; 0 for the first (SSS 3.2, 3.5).
/// None where no comparison spans it, as over a jump of the clock.
///
/// For every span k, F(e_k) / seconds is an estimate of the speed over it (SSS Eq. 3 has neighbouring frames
/// only); a frame's displacement is the least, over k, of the mean estimate of the spans that contain it,
/// times the time since the frame before. The least is taken because motion adds to the error over every
/// span, bounce only over short ones. Spans whose error lies on the clamped part of the model give only a
/// lower bound and are left out, except the shortest. Speed is limited to `max_speed`, in the model's unit
/// per second. All 0 for a model that learned nothing. `time_s`: one per frame, increasing. Throws
/// `std::invalid_argument` unless `separations` is in 1 .. the errors' spans, there is one time per frame,
/// and max_speed > 0. O(frames * separations^2).
std::vector<std::optional<double>> apply_motion_model(const AlignmentErrors& errors, const MotionModel& model,
                                                      std::span<const double> time_s, int separations,
                                                      double max_speed);

/// The same, in seconds at mean speed, by a model learned from the walk itself, or by one for each local
/// window. 0 where a gap of the clock leaves nothing to compare.
///
/// `excluded`: frames left out of learning, as from `high_error_windows` and `standing_frames`, or empty.
std::vector<double> estimate_motion(const AlignmentErrors& errors, const std::vector<bool>& excluded,
                                    std::span<const double> time_s, const MotionModelOptions& options = {});

}  // namespace vo
