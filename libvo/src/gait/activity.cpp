#include "vo/gait/activity.hpp"

#include "vo/gait/periodicity.hpp"
#include "vo/gait/step_length.hpp"
#include "vo/gait/walker.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

namespace vo {
namespace {

constexpr double kNear_s = 5;  // of a step

/// The time that a step takes, and the cadence around it.
struct Stepping {
  double begin_s = 0;
  double end_s = 0;
  double hz = 0;
};

std::vector<Stepping> stepping(std::span<const Step> steps, const PartialSteps& partial, double pause_s) {
  std::vector<Stepping> all;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::optional<double> hz = local_cadence_hz(steps, i, pause_s);
    if (!hz) continue;  // a single step is not gait
    const double end_s = steps[i].time_s;
    const bool first = i == 0 || end_s - steps[i - 1].time_s > pause_s;
    all.push_back({first ? end_s - 1 / *hz : steps[i - 1].time_s, end_s, *hz});
    if (i + 1 == steps.size() && partial.after > 0) all.push_back({end_s, end_s + partial.after / *hz, *hz});
  }
  return all;
}

/// How the picture flows past at each frame.
struct Passing {
  std::vector<Flow> steady;
  std::vector<bool> rides;
};

/// Frames [begin, end) of a second.
struct Seen {
  double reliable = 0;      ///< share of the frames
  double growth_per_s = 0;  ///< mean over the reliable frames
  double flow_rad_s = 0;    ///< mean over them, and no more than the steady flow
  bool rides_past = false;  ///< most of them
};

Seen seen_in(const GaitSignal& signal, const Passing& passing, std::size_t begin, std::size_t end) {
  Seen seen;
  double known = 0, right = 0, down = 0, steady = 0, rides = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (!signal.reliable[i]) continue;
    ++known;
    seen.growth_per_s += signal.growth_per_s[i];
    if (passing.steady.empty()) continue;
    right += signal.flow_per_s[i].right_rad;
    down += signal.flow_per_s[i].down_rad;
    steady += std::hypot(passing.steady[i].right_rad, passing.steady[i].down_rad);
    rides += passing.rides[i] ? 1 : 0;
  }
  if (known > 0) {
    seen.growth_per_s /= known;
    seen.flow_rad_s = std::min(std::hypot(right, down), steady) / known;
    seen.rides_past = 2 * rides > known;
  }
  if (end > begin) seen.reliable = known / static_cast<double>(end - begin);
  return seen;
}

/// Makes walking of running that lasts for less than `shortest_s` next to it: a few steps read early or late
/// look like that.
void remove_short_runs(std::vector<ActivitySecond>& seconds, double shortest_s) {
  const auto is = [&](std::size_t i, Activity activity) {
    return i < seconds.size() && seconds[i].activity == activity;
  };
  for (std::size_t begin = 0, end = 0; begin < seconds.size(); begin = std::max(end, begin + 1)) {
    for (end = begin; is(end, Activity::kRunning);) ++end;
    const bool in_a_walk = is(begin - 1, Activity::kWalking) || is(end, Activity::kWalking);
    if (!in_a_walk || static_cast<double>(end - begin) >= shortest_s) continue;
    for (std::size_t i = begin; i < end; ++i) seconds[i].activity = Activity::kWalking;
  }
}

bool steps_near(std::span<const Step> steps, double from_s, double to_s) {
  const auto after = std::ranges::lower_bound(steps, from_s - kNear_s, {}, &Step::time_s);
  return after != steps.end() && after->time_s <= to_s + kNear_s;
}

}  // namespace

std::string_view name_of(Activity activity) {
  switch (activity) {
    case Activity::kStanding:
      return "standing";
    case Activity::kWalking:
      return "walking";
    case Activity::kRunning:
      return "running";
    case Activity::kRiding:
      return "riding";
    case Activity::kUnknown:
      break;
  }
  return "unknown";
}

std::vector<ActivitySecond> detect_activity(const GaitSignal& signal, std::span<const Step> steps,
                                            const PartialSteps& partial, const ActivityOptions& options) {
  if (!(options.run_step_hz > 0 && options.min_reliable >= 0 && options.pause_s > 0))
    throw std::invalid_argument(
        "detect_activity: run_step_hz and pause_s above 0, min_reliable >= 0 expected");
  std::vector<ActivitySecond> seconds;
  const std::vector<double>& time_s = signal.time_s;
  if (time_s.empty()) return seconds;

  const std::size_t frames = time_s.size();
  const std::vector<Stepping> gait = stepping(steps, partial, options.pause_s);
  const auto quarter = static_cast<std::size_t>(std::lround(signal.rate_hz / 4));
  Passing passing{.steady = steady_flow(signal), .rides = {}};
  passing.rides = rides_past(signal, passing.steady);
  const bool may_ride = time_s.back() - time_s.front() >= kNear_s;  // steps in less may be too few to see
  std::size_t next = 0;                                             // the first of `gait` not yet over
  for (std::size_t begin = 0, end = 0; begin < frames; begin = end) {
    ActivitySecond second{.time_s = time_s.front() + static_cast<double>(seconds.size())};
    while (end < frames && time_s[end] < second.time_s + 1) ++end;
    const double end_s = std::min(second.time_s + 1, time_s.back()), length_s = end_s - second.time_s;
    const std::size_t count = end - begin;
    if (count > 0)
      second.amplitude_deg =
          sinusoid_amplitude(signal.orientation.values, begin + count / 2, count / 2 + quarter);

    double stepped_s = 0, steps_made = 0;
    while (next < gait.size() && gait[next].end_s <= second.time_s) ++next;
    for (std::size_t k = next; k < gait.size() && gait[k].begin_s < end_s; ++k) {
      const double share_s = std::min(gait[k].end_s, end_s) - std::max(gait[k].begin_s, second.time_s);
      if (!(share_s > 0)) continue;
      stepped_s += share_s;
      steps_made += share_s * gait[k].hz;
    }
    if (stepped_s > 0 && 2 * stepped_s >= length_s) {
      second.step_hz = steps_made / stepped_s;
      second.activity = second.step_hz >= options.run_step_hz ? Activity::kRunning : Activity::kWalking;
    } else if (const Seen seen = seen_in(signal, passing, begin, end);
               frames >= 3 && count > 0 && seen.reliable >= options.min_reliable) {
      const bool grows = std::abs(seen.growth_per_s) >= kLeastGrowth_per_s;
      if (!grows && seen.flow_rad_s < kLeastFlow_rad_s) {
        second.activity = Activity::kStanding;
      } else if (may_ride && (grows || seen.rides_past) && !steps_near(steps, second.time_s, end_s)) {
        second.activity = Activity::kRiding;
      }
    }
    seconds.push_back(second);
  }
  remove_short_runs(seconds, options.shortest_run_s);
  return seconds;
}

}  // namespace vo
