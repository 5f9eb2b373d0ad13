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

/// What the tracked points of one frame say of the camera's motion since the frame before. Changes over the
/// tracking window are divided by its frames. None where fewer points than asked were tracked.
struct FrameMotion {
  std::size_t matches = 0;  ///< points tracked over the window
  int window = 1;           ///< frames that it reached back
  std::optional<double>
      orientation_deg;             ///< change of the points' orientation; clockwise in the picture positive
  std::optional<double> shift_px;  ///< of the points, to the right positive
  std::optional<PictureMotion> picture;  ///< of the whole picture
  std::optional<Turn> turn;              ///< of the camera
};

/// Settings of `frame_motion`.
struct FrameMotionOptions {
  Average average = Average::kMedian;  ///< of orientation and shift over the points [PVO 4.3]
  std::size_t min_matches = 8;         ///< fewer are no measurement
  HeadingOptions heading;
};

/// Sums up a frame's points (PVO 4.3). Orientation changes are wrapped to half a turn before they are
/// averaged; the mean of angles is that of their directions. `camera`: of the frames the points were found
/// in. O(points).
FrameMotion frame_motion(const Tracks& tracks, const Camera& camera, const FrameMotionOptions& options = {});

/// What the values of a signal are, each as the change from one frame to the next.
enum class SignalUnit { kDegrees, kPixels };

/// "deg", "px".
std::string_view name_of(SignalUnit unit);

/// One value for each frame.
struct Signal {
  std::vector<double> values;
  SignalUnit unit = SignalUnit::kDegrees;
};

/// The least amplitude that gait has in a signal of so many frames a second: 1 degree or 0.5 pixels a second.
/// A still camera with the noise of a sensor has up to a quarter of that, as points and their orientations
/// are found no more exactly, and evenly enough at times to look like gait; a walker whose camera steadies
/// its picture twice that and more.
double least_gait(SignalUnit unit, double rate_hz);

/// The signals that steps are read from, and the direction walked in, for each frame of a walk.
struct GaitSignal {
  double rate_hz = 0;                ///< frames a second
  std::vector<double> time_s;        ///< of each frame
  Signal orientation;                ///< change of orientation, low-passed
  Signal shift;                      ///< x shift without turns and drift, low-passed
  Signal bounce;                     ///< picture's motion down without drift, low-passed
  std::vector<double> growth_per_s;  ///< share by which the picture grows in a second, low-passed
  std::vector<double> heading_rad;   ///< of the walker, clockwise, since the first frame
  double travel_rad = 0;             ///< how far right of where the camera looks the walker goes
  std::vector<std::size_t> matches;  ///< points tracked
  std::vector<bool> reliable;        ///< false where too few points were tracked
  std::size_t bridged = 0;           ///< frames that are not reliable, the first not counted
};

/// Settings of `gait_signal`.
struct GaitSignalOptions {
  LowpassOptions lowpass;
  double heading_cutoff_hz = 0.5;  ///< of the heading, slower than any stride; 0 leaves the trunk's swing in
};

/// Joins the frames' motions (PVO 4.3, 4.5): gaps bridged by straight lines and marked, never taken as zero;
/// low-passed without lag. The heading is the sum of the turns, freed of the trunk's swing with each stride,
/// which PVO trusts to cancel out over two steps. `time_s` is even, as filters take it to be (`even_motion`).
/// The camera need not look straight ahead, as it must for
/// PVO: where the walker goes is the median of what the frames say. Throws `std::invalid_argument` if there
/// is not one time for each frame, for fewer than two frames, or a frame rate that is not above twice the
/// filter's cut-off. O(n).
GaitSignal gait_signal(std::span<const FrameMotion> motion, std::span<const double> time_s,
                       const GaitSignalOptions& options = {});

}  // namespace vo
