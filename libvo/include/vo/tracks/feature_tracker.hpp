#pragma once

#include "vo/gait/gait_signal.hpp"
#include "vo/geometry/camera.hpp"
#include "vo/surf/surf.hpp"
#include "vo/tracks/matching.hpp"
#include "vo/tracks/tracking_window.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Settings of `FeatureTracker`.
struct FeatureTrackerOptions {
  int width_px = 640;  ///< wider frames are resized to it [PVO 5.1]; PVO was less accurate with less
  SurfOptions surf;
  MatchOptions match{.max_displacement_px = 100};  ///< a turn of 250 degrees a second at 25 frames/s
  int window = 3;                                  ///< frames [PVO 5.3 (5)]
  FrameMotionOptions motion;
  double fov_deg = 64.4;         ///< horizontal, of a camera without calibration [PVO 5.3 (6)]
  std::optional<Camera> camera;  ///< calibrated, of the recording's own size
};

/// From pictures to the motion of each frame: SURF -> matches with the frame before -> tracks over the window
/// -> their joint motion (PVO 4.2, 4.3). Keeps the last frame only.
class FeatureTracker {
 public:
  /// Throws `std::invalid_argument` for options out of range.
  explicit FeatureTracker(const FeatureTrackerOptions& options = {});

  /// Takes the next frames, 8 bit grey or BGR, all of one size, and returns the motion of each; the very
  /// first frame has none. Frames are processed in parallel, so pass several at a time; the result is the
  /// same for any batches. Throws `vo::Error` if a calibrated camera is of another size.
  std::vector<FrameMotion> push(std::span<const cv::Mat> frames);

 private:
  FeatureTrackerOptions options_;
  TrackingWindow window_;
  std::optional<Camera> camera_;    // of the resized frames, known from the first
  std::optional<Features> before_;  // of the last frame
};

}  // namespace vo
