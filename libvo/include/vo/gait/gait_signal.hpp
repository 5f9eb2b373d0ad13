#pragma once

#include "vo/gait/heading.hpp"
#include "vo/gait/lowpass.hpp"
#include "vo/gait/picture_motion.hpp"
#include "vo/geometry/camera.hpp"
#include "vo/tracks/tracking_window.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace vo {

enum class Average { kMedian, kMean };

/// How fast the picture moves past, as angles.
struct Flow {
  double right_rad = 0;
  double down_rad = 0;
};

/// What the tracked points of one frame show of the camera's motion since the frame before. Changes over the
/// tracking window are divided by its number of frames. None where too few points were tracked.
struct FrameMotion {
  std::size_t matches = 0;  ///< points tracked over the window
  int window = 1;           ///< frames that it reached back
  std::optional<double>
      orientation_deg;             ///< change of the points' orientation; clockwise in the picture positive
  std::optional<double> shift_px;  ///< of the points, to the right positive
  std::optional<PictureMotion> picture;  ///< of the whole picture
  std::optional<Turn> turn;              ///< of the camera
  std::optional<Flow> flow = {};         ///< of the middle of the picture
};

/// Settings of `frame_motion`.
struct FrameMotionOptions {
  Average average = Average::kMedian;  ///< of orientation and shift over the points [PVO 4.3]
  std::size_t min_matches = 8;         ///< fewer are no measurement
  HeadingOptions heading;
};

/// Averages a frame's points (PVO 4.3). Orientation changes are wrapped to half a turn first; the mean of
/// angles is that of their directions. `camera`: of the frames the points were found in. O(points).
FrameMotion frame_motion(const Tracks& tracks, const Camera& camera, const FrameMotionOptions& options = {});

/// The unit of a signal's values, which are changes from one frame to the next.
enum class SignalUnit { kDegrees, kPixels };

/// "deg", "px".
std::string_view name_of(SignalUnit unit);

/// One value for each frame.
struct Signal {
  std::vector<double> values;
  SignalUnit unit = SignalUnit::kDegrees;
};

/// The least amplitude of gait in a signal at `rate_hz` frames a second: 1 degree or 0.5 pixels a second. The
/// sensor noise of a still camera reaches a quarter of that, at times evenly enough to look like gait; a
/// walker whose camera steadies its picture has at least twice that.
double least_gait(SignalUnit unit, double rate_hz);

/// The signals that steps are read from, and the direction walked in, for each frame of a walk.
struct GaitSignal {
  double rate_hz = 0;                ///< frames a second
  std::vector<double> time_s;        ///< of each frame
  Signal orientation;                ///< change of orientation, low-passed
  Signal shift;                      ///< x shift without turns and drift, low-passed
  Signal bounce;                     ///< picture's motion down without drift, low-passed
  std::vector<double> growth_per_s;  ///< share by which the picture grows in a second, low-passed
  std::vector<Flow> flow_per_s;      ///< in a second, low-passed
  std::vector<double> heading_rad;   ///< of the walker, clockwise, since the first frame
  double travel_rad = 0;             ///< direction of travel, to the right of where the camera looks
  std::vector<std::size_t> matches;  ///< points tracked
  std::vector<bool> reliable;        ///< false where too few points were tracked
  std::size_t bridged = 0;           ///< frames that are not reliable, the first not counted
};

/// Settings of `gait_signal`.
struct GaitSignalOptions {
  LowpassOptions lowpass;
  double heading_cutoff_hz = 0.5;  ///< of the heading, slower than any stride; 0 leaves the trunk's swing in
};

/// Joins the frames' motions (PVO 4.3, 4.5): gaps are bridged by straight lines and marked, never taken as
/// zero; the result is low-passed without lag. The heading is the sum of the turns without the trunk's swing
/// in each stride, which PVO expects to cancel over two steps. `time_s` is evenly spaced, as filters require
/// (`even_motion`). The camera need not look straight ahead, as it must in PVO: the direction of travel is
/// the median over the frames. Throws `std::invalid_argument` if there is not one time for each frame, for
/// fewer than two frames, or a frame rate that is not above twice the filter's cut-off. O(n).
GaitSignal gait_signal(std::span<const FrameMotion> motion, std::span<const double> time_s,
                       const GaitSignalOptions& options = {});

}  // namespace vo
