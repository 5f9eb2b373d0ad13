#include "vo/gait/step_reading.hpp"

#include "vo/gait/pvo_steps.hpp"
#include "vo/gait/walker.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace vo {
namespace {

StepDetection detect(const Signal& values, const GaitSignal& signal, StepDetectionOptions options) {
  options.periodicity.min_amplitude =
      std::max(options.periodicity.min_amplitude, least_gait(values.unit, signal.rate_hz));
  return detect_steps(values.values, signal.time_s, signal.reliable, options);
}

StepDetection read_orientation(const GaitSignal& signal, const StepReadingOptions& options) {
  StepDetection steps = detect(signal.orientation, signal, options.detection);
  const bool asked_for = options.signal == StepSignal::kOrientation || options.detection.delta_min;
  if (!asked_for)
    steps = fill_steps(steps, detect(signal.shift, signal, options.detection), signal.matches, signal.time_s,
                       options.fusion);
  return walkers_steps(std::move(steps), camera_travels(signal));
}

StepDetection read_bounce(const GaitSignal& signal, const StepReadingOptions& options) {
  FootfallOptions footfalls = options.footfalls;
  footfalls.periodicity.min_amplitude =
      std::max(footfalls.periodicity.min_amplitude, least_gait(signal.bounce.unit, signal.rate_hz));
  const StepDetection legs = detect(signal.orientation, signal, options.detection);
  StepDetection steps = detect_footfalls(signal.bounce.values, signal.growth_per_s, signal.time_s,
                                         signal.reliable, legs.steps, footfalls);
  std::vector<bool> walked = camera_travels(signal);
  const std::vector<bool> walker =
      bounces_like_walker(signal, bounce_windows(signal.bounce.values, signal.time_s, footfalls.periodicity));
  for (std::size_t i = 0; i < walked.size(); ++i) walked[i] = walked[i] && walker[i];
  return walkers_steps(std::move(steps), walked);
}

StepDetection read_shift(const GaitSignal& signal, const StepReadingOptions& options) {
  StepDetection steps = detect(signal.shift, signal, options.detection);
  std::vector<std::size_t> frames;
  for (const Step& step : steps.steps) frames.push_back(step.frame);
  const StepDistance walked(signal.growth_per_s, signal.time_s, frames, options.footfalls.distance);
  steps = walkers_steps(complete_steps(std::move(steps), walked, signal.shift.values, signal.time_s),
                        camera_travels(signal));
  if (2 * steps.bridged <= steps.steps.size()) return steps;
  StepDetection none{.delta_min = steps.delta_min, .delta_dyn = std::move(steps.delta_dyn)};
  return none;
}

StepDetection read_as_published(const GaitSignal& signal, const StepReadingOptions& options) {
  return detect_steps_as_published(signal.orientation.values, signal.time_s,
                                   {.delta_min = options.detection.delta_min});
}

constexpr std::array kReaders{
    StepReader{StepSignal::kOrientation, "orientation", &GaitSignal::orientation, read_orientation},
    StepReader{StepSignal::kBounce, "bounce", &GaitSignal::bounce, read_bounce},
    StepReader{StepSignal::kShift, "x shift", &GaitSignal::shift, read_shift},
    StepReader{StepSignal::kPublished, "orientation by PVO", &GaitSignal::orientation, read_as_published,
               true}};

/// The bounce unless another signal resembles gait in more of the walk; of those, PVO's if it shows any step.
StepSignal best_signal(const StepDetection& by_orientation, const StepDetection& by_shift,
                       const StepDetection& by_bounce) {
  constexpr double kAsMuch = 0.9;  // windows at the two ends of a walk differ by chance
  const double others = std::max(by_orientation.gait_share, by_shift.gait_share);
  if (!by_bounce.steps.empty() && by_bounce.gait_share >= kAsMuch * others) return StepSignal::kBounce;
  return by_orientation.steps.empty() && !by_shift.steps.empty() ? StepSignal::kShift
                                                                 : StepSignal::kOrientation;
}

}  // namespace

std::span<const StepReader> step_readers() {
  return kReaders;
}

const StepReader& reader_of(StepSignal signal) {
  return kReaders[static_cast<std::size_t>(signal)];
}

StepReading read_steps(const GaitSignal& signal, const StepReadingOptions& options) {
  std::optional<StepSignal> asked = options.signal;
  if (!asked && options.detection.delta_min) asked = StepSignal::kOrientation;
  if (asked) return {*asked, reader_of(*asked).read(signal, options)};
  std::array<StepDetection, kReaders.size()> found;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!kReaders[i].on_request) found[i] = kReaders[i].read(signal, options);
  const auto of = [&](StepSignal which) -> StepDetection& { return found[static_cast<std::size_t>(which)]; };
  const StepSignal best =
      best_signal(of(StepSignal::kOrientation), of(StepSignal::kShift), of(StepSignal::kBounce));
  return {best, std::move(of(best))};
}

}  // namespace vo
