#include "vo/gait/gait_signal.hpp"

#include "vo/base/clock.hpp"
#include "vo/base/degrees.hpp"
#include "vo/base/median.hpp"
#include "vo/base/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>

namespace vo {
namespace {

constexpr double kSlowestBounce_hz = 1;  // one a step, two in a stride

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double mean_angle_rad(std::span<const double> angles_rad) {
  double sine = 0, cosine = 0;
  for (const double angle : angles_rad) {
    sine += std::sin(angle);
    cosine += std::cos(angle);
  }
  return std::atan2(sine, cosine);
}

/// The direction of travel, from the frames that show it.
double travel_rad(std::span<const FrameMotion> motion) {
  std::vector<double> told;
  for (const FrameMotion& frame : motion) {
    if (frame.turn && frame.turn->travel_rad) told.push_back(*frame.turn->travel_rad);
  }
  return told.empty() ? 0 : median(told);
}

}  // namespace

FrameMotion frame_motion(const Tracks& tracks, const Camera& camera, const FrameMotionOptions& options) {
  FrameMotion motion{
      .matches = tracks.points.size(), .orientation_deg = {}, .shift_px = {}, .picture = {}, .turn = {}};
  if (tracks.span == 0 || tracks.points.size() < std::max<std::size_t>(options.min_matches, 1)) return motion;
  std::vector<double> rotations_rad, shifts_px;
  for (const TrackedPoint& point : tracks.points) {
    rotations_rad.push_back(
        wrap_angle_rad(static_cast<double>(point.to.orientation_rad) - point.from.orientation_rad));
    shifts_px.push_back(static_cast<double>(point.to.x_px) - point.from.x_px);
  }
  const double frames = tracks.span;
  const bool by_median = options.average == Average::kMedian;
  motion.orientation_deg =
      (by_median ? median(rotations_rad) : mean_angle_rad(rotations_rad)) * kDegPerRad / frames;
  motion.shift_px = (by_median ? median(shifts_px) : mean(shifts_px)) / frames;
  motion.picture = picture_motion(tracks.points, camera.width_px, camera.height_px);
  if (motion.picture) {
    motion.picture = PictureMotion{motion.picture->right_px / frames, motion.picture->down_px / frames,
                                   motion.picture->growth / frames, motion.picture->roll_rad / frames};
    motion.flow = Flow{motion.picture->right_px / camera.fx_px, motion.picture->down_px / camera.fy_px};
  }
  motion.window = tracks.span;
  motion.turn = turn(tracks.points, camera, options.heading);
  if (motion.turn) {
    motion.turn->turn_rad /= frames;
    motion.turn->turn_per_travel /= frames;
  }
  return motion;
}

std::string_view name_of(SignalUnit unit) {
  return unit == SignalUnit::kDegrees ? "deg" : "px";
}

double least_gait(SignalUnit unit, double rate_hz) {
  constexpr double kLeast_deg_s = 1, kLeast_px_s = 0.5;
  return (unit == SignalUnit::kDegrees ? kLeast_deg_s : kLeast_px_s) / rate_hz;
}

GaitSignal gait_signal(std::span<const FrameMotion> motion, std::span<const double> time_s,
                       const GaitSignalOptions& options) {
  if (motion.size() != time_s.size()) throw std::invalid_argument("gait_signal: one time per frame expected");
  const double rate_hz = frame_rate_hz(time_s);
  GaitSignal signal{
      .rate_hz = rate_hz, .time_s = {time_s.begin(), time_s.end()}, .travel_rad = travel_rad(motion)};
  std::vector<double> orientation_deg, shifts_px, turns_rad, down_px, growth_per_s, flow_right, flow_down;
  std::vector<bool> seen;  // the picture's motion
  for (const FrameMotion& frame : motion) {
    signal.matches.push_back(frame.matches);
    signal.reliable.push_back(frame.orientation_deg && frame.shift_px && frame.turn);
    orientation_deg.push_back(frame.orientation_deg.value_or(0));
    shifts_px.push_back(frame.shift_px.value_or(0));
    const PictureMotion picture = frame.picture.value_or(PictureMotion{});
    down_px.push_back(picture.down_px);
    growth_per_s.push_back(picture.growth * rate_hz);
    const Flow flow = frame.flow.value_or(Flow{});
    flow_right.push_back(flow.right_rad * rate_hz);
    flow_down.push_back(flow.down_rad * rate_hz);
    seen.push_back(frame.picture.has_value());
    const Turn turn = frame.turn.value_or(Turn{});
    turns_rad.push_back(turn.turn_rad + turn.turn_per_travel * signal.travel_rad);
  }
  signal.bridged =
      static_cast<std::size_t>(std::count(signal.reliable.begin() + 1, signal.reliable.end(), false));
  const auto smooth = [&](std::span<const double> values) {
    return lowpass_zero_phase(values, rate_hz, options.lowpass);
  };
  signal.orientation = {smooth(bridge_gaps(orientation_deg, signal.reliable)), SignalUnit::kDegrees};
  signal.shift = {smooth(without_drift(bridge_gaps(shifts_px, signal.reliable), rate_hz)),
                  SignalUnit::kPixels};
  signal.bounce = {smooth(without_drift(bridge_gaps(down_px, seen), rate_hz, kSlowestBounce_hz)),
                   SignalUnit::kPixels};
  signal.growth_per_s = smooth(bridge_gaps(growth_per_s, seen));
  flow_right = smooth(bridge_gaps(flow_right, seen));
  flow_down = smooth(bridge_gaps(flow_down, seen));
  for (std::size_t i = 0; i < flow_right.size(); ++i)
    signal.flow_per_s.push_back({flow_right[i], flow_down[i]});

  turns_rad = bridge_gaps(turns_rad, signal.reliable);
  turns_rad.front() = 0;
  std::partial_sum(turns_rad.begin(), turns_rad.end(), std::back_inserter(signal.heading_rad));
  if (options.heading_cutoff_hz > 0) {
    signal.heading_rad =
        lowpass_zero_phase(signal.heading_rad, rate_hz, {.order = 2, .cutoff_hz = options.heading_cutoff_hz});
  }
  return signal;
}

}  // namespace vo
