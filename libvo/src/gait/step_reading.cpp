#include "vo/gait/step_reading.hpp"

#include <algorithm>
#include <utility>

namespace vo {
namespace {

/// The bounce unless another signal is like gait in more of the walk; of those, PVO's if it shows any step.
StepSignal best_signal(const StepDetection& by_orientation, const StepDetection& by_shift,
                       const StepDetection& by_bounce) {
  constexpr double kAsMuch = 0.9;  // windows at the two ends of a walk differ by chance
  const double others = std::max(by_orientation.gait_share, by_shift.gait_share);
  if (!by_bounce.steps.empty() && by_bounce.gait_share >= kAsMuch * others) return StepSignal::kBounce;
  return by_orientation.steps.empty() && !by_shift.steps.empty() ? StepSignal::kShift
                                                                 : StepSignal::kOrientation;
}

StepDetection with_lost_steps(StepDetection by_shift, const GaitSignal& signal,
                              std::span<const double> time_s, const StepWayOptions& options) {
  std::vector<std::size_t> frames;
  for (const Step& step : by_shift.steps) frames.push_back(step.frame);
  const StepWay way(signal.growth, time_s, frames, options);
  return complete_steps(std::move(by_shift), way, signal.filtered_shift_px, time_s);
}

}  // namespace

StepReading read_steps(const GaitSignal& signal, std::span<const std::size_t> matches,
                       std::span<const double> time_s, const StepReadingOptions& options) {
  const auto detect = [&](StepSignal which) {
    return detect_steps(values_of(which, signal), time_s, signal.reliable, options.detection);
  };
  StepDetection by_orientation = detect(StepSignal::kOrientation);
  if (options.signal == StepSignal::kOrientation || options.detection.delta_min_deg)
    return {StepSignal::kOrientation, StepSignal::kOrientation, std::move(by_orientation)};

  StepReading reading;
  if (by_orientation.gait_share == 0) reading.stride = StepSignal::kShift;
  StepDetection by_shift = detect(StepSignal::kShift);
  StepDetection by_bounce = detect_footfalls(signal.bounce_px, signal.growth, time_s, signal.reliable,
                                             by_orientation.steps, options.footfalls);
  reading.signal = options.signal.value_or(best_signal(by_orientation, by_shift, by_bounce));
  switch (reading.signal) {
    case StepSignal::kBounce:
      reading.detection = std::move(by_bounce);
      break;
    case StepSignal::kShift:
      reading.detection = with_lost_steps(std::move(by_shift), signal, time_s, options.footfalls.way);
      break;
    case StepSignal::kOrientation:
      reading.detection = fill_steps(by_orientation, by_shift, matches, time_s, options.fusion);
      break;
  }
  return reading;
}

const std::vector<double>& values_of(StepSignal which, const GaitSignal& signal) {
  switch (which) {
    case StepSignal::kBounce:
      return signal.bounce_px;
    case StepSignal::kShift:
      return signal.filtered_shift_px;
    case StepSignal::kOrientation:
      break;
  }
  return signal.filtered_orientation_deg;
}

}  // namespace vo
