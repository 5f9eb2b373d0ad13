#include "vo/gait/footfall.hpp"

#include "vo/base/clock.hpp"
#include "vo/gait/lowpass.hpp"

#include <algorithm>
#include <stdexcept>

namespace vo {
namespace {

/// The bounce, and its usual size around each frame.
struct Bounce {
  std::span<const double> px;
  std::vector<Periodicity> windows;  ///< step_s: half a bounce, i.e. half a step
  std::vector<double> amplitude_px;  ///< largest of the windows of gait around each frame; 0 without any
};

/// Unlike the median of the windows that cover a frame, the largest within two windows does not drop next to
/// a pause.
std::vector<double> largest_amplitude(const std::vector<Periodicity>& windows, std::size_t frames) {
  std::vector<double> largest(frames, 0);
  std::vector<bool> covered(frames, false);
  for (const Periodicity& window : windows) {
    if (!window.gait) continue;
    const auto about = [&](std::size_t reach) {
      return std::pair(window.frame - std::min(window.frame, reach),
                       std::min(frames, window.frame + reach + 1));
    };
    const auto [begin, end] = about(window.reach);
    std::fill(covered.begin() + static_cast<std::ptrdiff_t>(begin),
              covered.begin() + static_cast<std::ptrdiff_t>(end), true);
    const auto [first, last] = about(3 * window.reach);
    for (std::size_t i = first; i < last; ++i) largest[i] = std::max(largest[i], window.amplitude);
  }
  for (std::size_t i = 0; i < frames; ++i) largest[i] = covered[i] ? largest[i] : 0;
  return largest;
}

/// Valleys at least this deep, as a share of the usual depth around them; of those within half a step, the
/// deepest.
std::vector<std::size_t> valleys(const Bounce& bounce, std::span<const double> time_s,
                                 const std::vector<bool>& reliable, double depth) {
  std::vector<std::size_t> found;
  for (std::size_t i = 1; i + 1 < bounce.px.size(); ++i) {
    if (!(bounce.px[i] < bounce.px[i - 1] && bounce.px[i] <= bounce.px[i + 1]) || !reliable[i]) continue;
    if (bounce.amplitude_px[i] == 0 || -bounce.px[i] < depth * bounce.amplitude_px[i]) continue;
    if (found.empty() || time_s[i] - time_s[found.back()] >= nearest_window(bounce.windows, i).step_s) {
      found.push_back(i);
    } else if (bounce.px[i] < bounce.px[found.back()]) {
      found.back() = i;
    }
  }
  return found;
}

/// Left and right alternate, beginning with the leg that agrees with more of the legs seen.
void name_legs(std::vector<Step>& steps, std::span<const Step> legs) {
  constexpr double kSame_s = 0.35;
  int votes = 0;  // in favour of the first being left
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    // The camera rolls fastest before the foot lands.
    while (nearest + 1 < legs.size() && legs[nearest + 1].time_s <= steps[i].time_s) ++nearest;
    if (legs.empty() || legs[nearest].time_s > steps[i].time_s ||
        steps[i].time_s - legs[nearest].time_s > kSame_s)
      continue;
    votes += (legs[nearest].leg == Leg::kLeft) == (i % 2 == 0) ? 1 : -1;
  }
  for (std::size_t i = 0; i < steps.size(); ++i)
    steps[i].leg = (i % 2 == 0) == (votes >= 0) ? Leg::kLeft : Leg::kRight;
}

}  // namespace

std::vector<Periodicity> bounce_windows(std::span<const double> bounce_px, std::span<const double> time_s,
                                        const PeriodicityOptions& options) {
  PeriodicityOptions in_halves = options;
  in_halves.min_step_hz *= 2;
  in_halves.max_step_hz *= 2;
  return stride_periodicity(bounce_px, time_s.size() < 2 ? 1 : frame_rate_hz(time_s), in_halves);
}

StepDetection detect_footfalls(std::span<const double> bounce_px, std::span<const double> growth,
                               std::span<const double> time_s, const std::vector<bool>& reliable,
                               std::span<const Step> legs, const FootfallOptions& options) {
  const std::size_t frames = bounce_px.size();
  if (growth.size() != frames || time_s.size() != frames || reliable.size() != frames)
    throw std::invalid_argument("detect_footfalls: one value of each per frame expected");
  if (!(options.min_depth > 0 && options.sure_depth >= options.min_depth))
    throw std::invalid_argument("detect_footfalls: 0 < min_depth <= sure_depth expected");
  StepDetection result;
  result.delta_dyn.assign(frames, 0);
  if (frames < 3) return result;

  Bounce bounce{
      .px = bounce_px, .windows = bounce_windows(bounce_px, time_s, options.periodicity), .amplitude_px = {}};
  const auto average_px = gait_amplitude(bounce.windows);
  if (!average_px) return result;
  bounce.amplitude_px = largest_amplitude(bounce.windows, frames);
  result.delta_min = options.min_depth * *average_px;
  result.gait_share =
      static_cast<double>(std::ranges::count_if(bounce.amplitude_px, [](double px) { return px > 0; })) /
      static_cast<double>(frames);
  for (std::size_t i = 0; i < frames; ++i) result.delta_dyn[i] = options.min_depth * bounce.amplitude_px[i];

  const StepDistance walked(growth, time_s, valleys(bounce, time_s, reliable, options.sure_depth),
                            options.distance);
  if (!walked.known()) return result;
  std::vector<std::size_t> falls = valleys(bounce, time_s, reliable, options.min_depth);
  const auto sure = [&](std::size_t i) {
    return -bounce_px[i] >= options.sure_depth * bounce.amplitude_px[i];
  };
  std::erase_if(falls, [&](std::size_t i) { return !sure(i) && !walked.walking(i); });
  // Next to a pause, a swing that dies away is not a step; its distance goes to the gap.
  const auto swings_out = [&](std::size_t i, std::size_t from, std::size_t stand) {
    const auto [a, b] = std::minmax(i, from);
    const auto [c, d] = std::minmax(i, stand);
    return !sure(i) && !walked.gap(a, b) && walked.gap(c, d) && walked.between(a, b) < options.min_step;
  };
  for (std::size_t k = 0; k < falls.size(); ++k) {
    const std::size_t before = k > 0 ? falls[k - 1] : 0;
    const std::size_t after = k + 1 < falls.size() ? falls[k + 1] : frames - 1;
    if (swings_out(falls[k], before, after) || swings_out(falls[k], after, before)) continue;
    result.steps.push_back({falls[k], time_s[falls[k]], Leg::kLeft, bounce_px[falls[k]], false});
  }
  result = complete_steps(std::move(result), walked, bounce_px, time_s);
  name_legs(result.steps, legs);
  return result;
}

}  // namespace vo
