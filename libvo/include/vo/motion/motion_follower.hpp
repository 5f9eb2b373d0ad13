#pragma once

#include "vo/motion/alignment_error.hpp"
#include "vo/motion/motion_model.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace vo {

/// How far a camera moved since the frame before, as far as the frames up to now can say.
struct FollowedMotion {
  double moved_s = 0;      ///< seconds at the mean speed of the walk so far, >= 0
  double variance_s2 = 0;  ///< of that, as of an error independent from frame to frame
  bool standing = false;   ///< the camera stays at one place
  bool learned = false;  ///< false: not enough was seen yet, or nothing can be seen; the mean speed is taken
};

/// Settings of `MotionFollower`.
struct MotionFollowerOptions {
  std::size_t spans = 10;       ///< as `AlignmentErrorOptions::spans`
  std::size_t separations = 5;  ///< as `MotionModelOptions::separations`
  double max_speed = 2;         ///< as `MotionModelOptions::max_speed`
  double memory_s = 60;         ///< the model is learned from about so much of the walk before the frame
  double standing_span_s = 2;   ///< as `StandingOptions::span_s`
};

/// Motion from alignment error (SSS 3.1 to 3.3) while walking: `visual_motion` without a look at what is to
/// come. Mean errors are averages that forget (`memory_s`), as SSS 3's local temporal window; a frame's speed
/// is the least that the spans ending at it say, in proportion to what they said so far, where the batch form
/// also has spans that end after it; a pause is noticed `standing_span_s` after it began; from then
/// on the displacement is 0.
///
/// Memory: the pictures of the last `standing_span_s`, and one for each of the last 30 seconds.
class MotionFollower {
 public:
  /// Throws `std::invalid_argument` for options out of range.
  explicit MotionFollower(const MotionFollowerOptions& options = {});

  /// `normalised`: bytes of `patch_normalise`, all of one size. `time_s`: later than the one before; throws
  /// `std::invalid_argument` otherwise. `seen`: false for a picture that shows nothing (black, out of focus),
  /// which is neither compared nor learned from. O(pixels * spans).
  FollowedMotion push(std::span<const std::uint8_t> normalised, double time_s, bool seen = true);

 private:
  struct Past {
    double time_s = 0;
    std::vector<std::uint8_t> pixels;
    bool seen = true;
  };
  /// Of one span, over the frames so far, the later ones weighing more.
  struct Mean {
    double weight = 0, error = 0, seconds = 0;
  };

  [[nodiscard]] const Past* nearest(double time_s, double within_s) const;
  bool stands(const Past& now);
  void learn(const std::vector<Comparison>& compared, double since_s);

  MotionFollowerOptions options_;
  std::deque<Past> past_;     // the last frames, oldest first
  std::deque<Past> distant_;  // one a second
  std::vector<double> distant_errors_;
  double span_s_ = kAlignmentSpan_s;
  double clock_s_ = 0;  ///< of all intervals between frames that are no gaps
  std::size_t intervals_ = 0;
  std::vector<Mean> means_;
  MotionModel model_;
  SeparationCurve curve_;  ///< of the model
  double learned_at_s_ = 0, moving_s_ = 0;
  double estimated_s_ = 1, walked_s_ = 1;  // by the model, and by the clock; from a second of both on
};

}  // namespace vo
