#include "vo/gait/dead_reckoning.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace vo {
namespace {

/// When each step begins.
std::vector<double> begin_of_steps_s(std::span<const Step> steps, double pause_s) {
  std::vector<double> durations_s;
  for (std::size_t i = 1; i < steps.size(); ++i) durations_s.push_back(steps[i].time_s - steps[i - 1].time_s);
  const auto is_step = [&](std::size_t i) { return i < durations_s.size() && durations_s[i] <= pause_s; };

  std::vector<double> usual_s;
  std::ranges::copy_if(durations_s, std::back_inserter(usual_s), [&](double s) { return s <= pause_s; });
  if (usual_s.empty()) usual_s = {0.5};
  const double usual_step_s = median(usual_s);

  std::vector<double> begin_s;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i > 0 && is_step(i - 1)) {
      begin_s.push_back(steps[i - 1].time_s);
    } else {
      begin_s.push_back(steps[i].time_s - (is_step(i) ? durations_s[i] : usual_step_s));
    }
  }
  return begin_s;
}

}  // namespace

std::vector<double> step_displacement_m(std::span<const Step> steps, std::span<const double> lengths_m,
                                        std::span<const double> time_s, const DeadReckoningOptions& options) {
  if (lengths_m.size() != steps.size())
    throw std::invalid_argument("step_displacement_m: one length per step expected");
  std::vector<double> displacement_m(time_s.size(), 0);
  const std::vector<double> begin_s = begin_of_steps_s(steps, options.pause_s);
  std::size_t before = 0;  // the frame of the step before
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::size_t frame = steps[i].frame;
    if (frame <= before || frame >= time_s.size())
      throw std::invalid_argument("step_displacement_m: frames that increase, of the walk, expected");
    const double first_s = std::max(begin_s[i], time_s[before]);
    const double metres_per_s = lengths_m[i] / (time_s[frame] - first_s);
    for (std::size_t f = frame; f > before && time_s[f] > first_s; --f)
      displacement_m[f] = metres_per_s * (time_s[f] - std::max(time_s[f - 1], first_s));
    before = frame;
  }
  return displacement_m;
}

DeadReckoning dead_reckon(std::span<const Step> steps, std::span<const double> lengths_m,
                          std::span<const double> heading_rad, std::span<const double> time_s,
                          const DeadReckoningOptions& options) {
  if (heading_rad.size() != time_s.size())
    throw std::invalid_argument("dead_reckon: one heading per frame expected");
  const std::vector<double> displacement_m = step_displacement_m(steps, lengths_m, time_s, options);
  DeadReckoning walk;
  double x_m = 0, y_m = 0;
  std::size_t frame = 0;
  const auto go_on = [&](double metres, double towards_rad) {
    x_m += metres * std::sin(towards_rad);
    y_m += metres * std::cos(towards_rad);
    walk.at_frame.push_back({time_s[frame], {x_m, y_m, wrap_angle_rad(heading_rad[frame])}});
    ++frame;
  };
  for (const Step& step : steps) {
    const double from_x_m = x_m, from_y_m = y_m;
    while (frame <= step.frame)
      go_on(displacement_m[frame], heading_rad[options.heading_over_step ? frame : step.frame]);
    const double heading = options.heading_over_step ? std::atan2(x_m - from_x_m, y_m - from_y_m)
                                                     : wrap_angle_rad(heading_rad[step.frame]);
    walk.at_step.push_back({x_m, y_m, heading});
  }
  while (frame < time_s.size()) go_on(0, 0);
  return walk;
}

}  // namespace vo
