#include "vo/gait/even_motion.hpp"

#include "vo/base/clock.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace vo {
namespace {

/// The motion of one frame scaled to `frame_s`, and the time it belongs to.
struct Measured {
  double time_s = 0;
  FrameMotion motion;
};

std::optional<double> scaled(const std::optional<double>& value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

FrameMotion scaled(FrameMotion motion, double factor) {
  motion.orientation_deg = scaled(motion.orientation_deg, factor);
  motion.shift_px = scaled(motion.shift_px, factor);
  if (motion.picture) {
    auto& [right_px, down_px, growth, roll_rad] = *motion.picture;
    for (double* value : {&right_px, &down_px, &growth, &roll_rad}) *value *= factor;
  }
  if (motion.flow) motion.flow = Flow{motion.flow->right_rad * factor, motion.flow->down_rad * factor};
  if (motion.turn) {
    motion.turn->turn_rad *= factor;
    motion.turn->turn_per_travel *= factor;
  }
  return motion;
}

std::vector<Measured> measured(std::span<const FrameMotion> motion, std::span<const double> time_s,
                               double frame_s) {
  std::vector<bool> after_gap(time_s.size(), false);
  for (const ClockGap& gap : clock_gaps(time_s)) after_gap[gap.frame] = true;
  std::vector<Measured> all;
  std::size_t since_gap = time_s.size();  // frames
  for (std::size_t i = 0; i < motion.size(); ++i) {
    since_gap = after_gap[i] ? 0 : since_gap + 1;
    const std::size_t window = std::min(i, static_cast<std::size_t>(std::max(1, motion[i].window)));
    Measured here{.time_s = time_s[i], .motion = {.matches = motion[i].matches}};
    if (window > 0 && since_gap >= window) {
      const double usual_s = static_cast<double>(window) * frame_s, window_s = time_s[i] - time_s[i - window];
      here.time_s += (usual_s - window_s) / 2;
      here.motion = scaled(motion[i], usual_s / window_s);
    }
    all.push_back(std::move(here));
  }
  return all;
}

std::optional<double> mixed(const std::optional<double>& a, const std::optional<double>& b, double share) {
  if (share <= 0) return a;
  if (share >= 1) return b;
  return a && b ? std::optional(std::lerp(*a, *b, share)) : std::nullopt;
}

FrameMotion mixed(const FrameMotion& a, const FrameMotion& b, double share) {
  FrameMotion motion{.matches = share < 0.5 ? a.matches : b.matches, .window = std::max(a.window, b.window)};
  motion.orientation_deg = mixed(a.orientation_deg, b.orientation_deg, share);
  motion.shift_px = mixed(a.shift_px, b.shift_px, share);
  if (share <= 0 || share >= 1) {
    motion.picture = share <= 0 ? a.picture : b.picture;
    motion.turn = share <= 0 ? a.turn : b.turn;
    motion.flow = share <= 0 ? a.flow : b.flow;
    return motion;
  }
  if (a.picture && b.picture) {
    motion.picture = PictureMotion{std::lerp(a.picture->right_px, b.picture->right_px, share),
                                   std::lerp(a.picture->down_px, b.picture->down_px, share),
                                   std::lerp(a.picture->growth, b.picture->growth, share),
                                   std::lerp(a.picture->roll_rad, b.picture->roll_rad, share)};
  }
  if (a.flow && b.flow) {
    motion.flow = Flow{std::lerp(a.flow->right_rad, b.flow->right_rad, share),
                       std::lerp(a.flow->down_rad, b.flow->down_rad, share)};
  }
  if (a.turn && b.turn) {
    motion.turn = Turn{.turn_rad = std::lerp(a.turn->turn_rad, b.turn->turn_rad, share),
                       .turn_per_travel = std::lerp(a.turn->turn_per_travel, b.turn->turn_per_travel, share),
                       .travel_rad = share < 0.5 ? a.turn->travel_rad : b.turn->travel_rad};
  }
  return motion;
}

std::vector<Flow> flow_at(const GaitSignal& even, std::span<const double> time_s) {
  if (even.flow_per_s.empty()) return {};
  std::vector<double> right, down;
  for (const Flow& flow : even.flow_per_s) {
    right.push_back(flow.right_rad);
    down.push_back(flow.down_rad);
  }
  right = read_at(right, even.time_s, time_s);
  down = read_at(down, even.time_s, time_s);
  std::vector<Flow> flow;
  for (std::size_t i = 0; i < right.size(); ++i) flow.push_back({right[i], down[i]});
  return flow;
}

}  // namespace

EvenMotion even_motion(std::span<const FrameMotion> motion, std::span<const double> time_s) {
  if (motion.size() != time_s.size()) throw std::invalid_argument("even_motion: one time per frame expected");
  EvenMotion even{.rate_hz = frame_rate_hz(time_s)};
  const double frame_s = 1 / even.rate_hz;
  const std::vector<Measured> all = measured(motion, time_s, frame_s);
  const auto count =
      1 + static_cast<std::size_t>(std::lround((time_s.back() - time_s.front()) * even.rate_hz));
  std::size_t after = 0;
  for (std::size_t k = 0; k < count; ++k) {
    even.time_s.push_back(time_s.front() + static_cast<double>(k) * frame_s);
    // Times are rounded to milliseconds; those of an even frame rate must be met exactly.
    const double at_s = even.time_s.back(), near_s = std::min(0.001, frame_s / 20);
    while (after + 1 < all.size() && all[after].time_s < at_s - near_s) ++after;
    const Measured &b = all[after], &a = all[after > 0 ? after - 1 : 0];
    if (std::abs(b.time_s - at_s) <= near_s || after == 0) {
      even.motion.push_back(b.motion);
    } else if (b.time_s < at_s || b.time_s - a.time_s >= kShortestGap_s) {
      even.motion.emplace_back();
    } else {
      even.motion.push_back(mixed(a.motion, b.motion, (at_s - a.time_s) / (b.time_s - a.time_s)));
    }
  }
  return even;
}

std::vector<double> read_at(std::span<const double> values, std::span<const double> even_s,
                            std::span<const double> at_s) {
  if (values.size() != even_s.size() || values.empty())
    throw std::invalid_argument("read_at: one value for each time expected");
  std::vector<double> read;
  for (const double time_s : at_s) {
    const auto after = static_cast<std::size_t>(std::ranges::lower_bound(even_s, time_s) - even_s.begin());
    if (after == 0 || after == even_s.size()) {
      read.push_back(after == 0 ? values.front() : values.back());
      continue;
    }
    const double share = (time_s - even_s[after - 1]) / (even_s[after] - even_s[after - 1]);
    read.push_back(std::lerp(values[after - 1], values[after], share));
  }
  return read;
}

GaitSignal signal_at_frames(const GaitSignal& even, std::span<const FrameMotion> motion,
                            std::span<const double> time_s) {
  const auto at_frames = [&](std::span<const double> values) { return read_at(values, even.time_s, time_s); };
  GaitSignal signal{.rate_hz = even.rate_hz,
                    .time_s = {time_s.begin(), time_s.end()},
                    .orientation = {at_frames(even.orientation.values), even.orientation.unit},
                    .shift = {at_frames(even.shift.values), even.shift.unit},
                    .bounce = {at_frames(even.bounce.values), even.bounce.unit},
                    .growth_per_s = at_frames(even.growth_per_s),
                    .flow_per_s = flow_at(even, time_s),
                    .heading_rad = at_frames(even.heading_rad),
                    .travel_rad = even.travel_rad};
  for (const FrameMotion& frame : motion) {
    signal.matches.push_back(frame.matches);
    signal.reliable.push_back(frame.orientation_deg && frame.shift_px && frame.turn);
  }
  signal.bridged =
      static_cast<std::size_t>(std::count(signal.reliable.begin() + 1, signal.reliable.end(), false));
  return signal;
}

}  // namespace vo
