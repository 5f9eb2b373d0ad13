#include "vo/gait/dead_reckoning.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace vo {
namespace {

/// When each step ends, as if left and right took equally long: half the difference between the median
/// intervals that end with a right and with a left step is moved from one to the other.
std::vector<double> even_times_s(std::span<const Step> steps, double pause_s) {
  std::vector<double> to_left_s, to_right_s, time_s;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    time_s.push_back(steps[i].time_s);
    if (i == 0 || steps[i].leg == steps[i - 1].leg) continue;
    const double interval_s = steps[i].time_s - steps[i - 1].time_s;
    if (interval_s <= pause_s) (steps[i].leg == Leg::kLeft ? to_left_s : to_right_s).push_back(interval_s);
  }
  if (to_left_s.empty() || to_right_s.empty()) return time_s;
  const double later_s = (median(to_left_s) - median(to_right_s)) / 4;
  for (std::size_t i = 0; i < steps.size(); ++i)
    time_s[i] += steps[i].leg == Leg::kRight ? later_s : -later_s;
  return time_s;
}

/// How long each step takes: the time since the one before it, or the usual time after a pause.
std::vector<double> durations_s(std::span<const double> done_s, double pause_s) {
  std::vector<double> between_s, usual_s;
  for (std::size_t i = 1; i < done_s.size(); ++i) between_s.push_back(done_s[i] - done_s[i - 1]);
  const auto is_step = [&](std::size_t i) { return i < between_s.size() && between_s[i] <= pause_s; };
  std::ranges::copy_if(between_s, std::back_inserter(usual_s), [&](double s) { return s <= pause_s; });
  if (usual_s.empty()) usual_s = {0.5};
  const double usual_step_s = median(usual_s);

  std::vector<double> duration_s;
  for (std::size_t i = 0; i < done_s.size(); ++i) {
    if (i > 0 && is_step(i - 1)) {
      duration_s.push_back(between_s[i - 1]);
    } else {
      duration_s.push_back(is_step(i) ? between_s[i] : usual_step_s);
    }
  }
  return duration_s;
}

}  // namespace

std::vector<double> step_displacement_m(std::span<const Step> steps, std::span<const double> lengths_m,
                                        std::span<const double> time_s, const PartialSteps& partial,
                                        const DeadReckoningOptions& options) {
  if (lengths_m.size() != steps.size())
    throw std::invalid_argument("step_displacement_m: one length per step expected");
  if (!(partial.first >= 0 && partial.first <= 1 && partial.after >= 0 && partial.after <= 1))
    throw std::invalid_argument("step_displacement_m: shares of a step from 0 to 1 expected");
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].frame < (i == 0 ? 1 : steps[i - 1].frame) || steps[i].frame >= time_s.size())
      throw std::invalid_argument("step_displacement_m: frames that do not decrease, of the walk, expected");
  }
  std::vector<double> displacement_m(time_s.size(), 0);
  if (steps.empty()) return displacement_m;
  std::vector<double> done_s;
  for (const Step& step : steps) done_s.push_back(step.time_s);
  if (!options.as_published) done_s = even_times_s(steps, options.pause_s);
  std::vector<double> duration_s = durations_s(done_s, options.pause_s);
  std::vector<double> way_m(lengths_m.begin(), lengths_m.end());
  way_m.push_back(partial.after * way_m.back());
  duration_s.push_back(partial.after * duration_s.back());
  done_s.push_back(done_s.back() + duration_s.back());
  way_m.front() *= partial.first;
  duration_s.front() *= partial.first;

  double whole_m = 0, before_m = 0;  // of the completed steps; up to the frame before
  double before_s = time_s.front();  // when the step before ended
  std::size_t step = 0;
  for (std::size_t frame = 1; frame < time_s.size(); ++frame) {
    double here_m = whole_m;
    for (; step < way_m.size(); ++step) {
      const double end_s = std::clamp(done_s[step], before_s, time_s.back());
      const double begin_s = std::clamp(end_s - duration_s[step], before_s, end_s);
      if (end_s > time_s[frame]) {
        const double share = (time_s[frame] - begin_s) / (end_s - begin_s);
        here_m = whole_m + std::max(0.0, share) * way_m[step];
        break;
      }
      here_m = whole_m += way_m[step];
      before_s = end_s;
    }
    displacement_m[frame] = here_m - before_m;
    before_m = here_m;
  }
  return displacement_m;
}

DeadReckoning dead_reckon(std::span<const Step> steps, std::span<const double> lengths_m,
                          std::span<const double> heading_rad, std::span<const double> time_s,
                          const PartialSteps& partial, const DeadReckoningOptions& options) {
  if (heading_rad.size() != time_s.size())
    throw std::invalid_argument("dead_reckon: one heading per frame expected");
  const std::vector<double> displacement_m = step_displacement_m(steps, lengths_m, time_s, partial, options);
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
      go_on(displacement_m[frame], heading_rad[options.as_published ? step.frame : frame]);
    const bool moved = x_m != from_x_m || y_m != from_y_m;  // not within a gap of the clock
    const double heading = !options.as_published && moved ? std::atan2(x_m - from_x_m, y_m - from_y_m)
                                                          : wrap_angle_rad(heading_rad[step.frame]);
    walk.at_step.push_back({x_m, y_m, heading});
  }
  while (frame < time_s.size()) go_on(displacement_m[frame], heading_rad[frame]);
  return walk;
}

Trajectory dead_reckon(std::span<const double> displacement_m, std::span<const double> heading_rad,
                       std::span<const double> time_s) {
  if (displacement_m.size() != time_s.size() || heading_rad.size() != time_s.size())
    throw std::invalid_argument("dead_reckon: one displacement and one heading per frame expected");
  Trajectory trajectory;
  double x_m = 0, y_m = 0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    x_m += displacement_m[i] * std::sin(heading_rad[i]);
    y_m += displacement_m[i] * std::cos(heading_rad[i]);
    trajectory.push_back({time_s[i], {x_m, y_m, wrap_angle_rad(heading_rad[i])}});
  }
  return trajectory;
}

}  // namespace vo
