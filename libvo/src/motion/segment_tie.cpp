#include "vo/motion/segment_tie.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vo {
namespace {

/// Mean speed over the known frames of a range; none if they are less than half of its time or do not move.
std::optional<double> speed_over(std::span<const double> time_s,
                                 std::span<const std::optional<double>> displacement, FrameRange range) {
  double moved = 0, known_s = 0, all_s = 0;
  for (std::size_t i = std::max<std::size_t>(range.begin, 1); i < range.end; ++i) {
    const double length_s = time_s[i] - time_s[i - 1];
    all_s += length_s;
    if (!displacement[i]) continue;
    moved += *displacement[i];
    known_s += length_s;
  }
  if (!(moved > 0) || known_s < all_s / 2) return std::nullopt;
  return moved / known_s;
}

/// The frames of the `length_s` seconds from `at_s` on.
FrameRange seconds_from(std::span<const double> time_s, double at_s, double length_s) {
  const auto index = [&](double t) {
    return static_cast<std::size_t>(std::ranges::lower_bound(time_s, t) - time_s.begin());
  };
  return {index(at_s), index(at_s + length_s)};
}

/// Root mean square change of the logarithm of speed over that many seconds; none if too little is known.
std::optional<double> speed_change(std::span<const double> time_s,
                                   std::span<const std::optional<double>> displacement, double over_s,
                                   double speed_s) {
  constexpr std::size_t kFew = 5;
  double square = 0;
  std::size_t count = 0;
  for (double t = time_s.front(); t + over_s + speed_s <= time_s.back(); t += speed_s) {
    const auto before = speed_over(time_s, displacement, seconds_from(time_s, t, speed_s));
    const auto after = speed_over(time_s, displacement, seconds_from(time_s, t + over_s, speed_s));
    if (!before || !after) continue;
    square += std::pow(std::log(*after / *before), 2);
    ++count;
  }
  if (count < kFew) return std::nullopt;
  return std::sqrt(square / static_cast<double>(count));
}

/// One past the last known frame before `end`; 0 if none is known.
std::size_t last_known(std::span<const std::optional<double>> displacement, std::size_t end) {
  while (end > 0 && !displacement[end - 1]) --end;
  return end;
}

/// The frames before `end` that contain `wanted` known ones, or all of them; reaches further back after a
/// long loss.
FrameRange known_before(std::span<const std::optional<double>> displacement, std::size_t end,
                        std::size_t wanted) {
  FrameRange before{end, end};
  for (std::size_t found = 0; before.begin > 0 && found < wanted; --before.begin)
    found += displacement[before.begin - 1] ? 1 : 0;
  return before;
}

/// The frames whose alignment error shows distance: in a turn the picture changes without any.
std::vector<bool> usable_errors(const MotionEvidence& evidence) {
  constexpr double kTurning_rad_s = 0.1;  // at 10 m/s it shifts points 50 m away as much as the motion does
  std::vector<bool> usable = evidence.errors_known;
  for (std::size_t i = 1; i < usable.size() && evidence.track != nullptr; ++i) {
    const std::optional<double>& turn_rad = evidence.track->frames[i].turn_rad;
    const double length_s = evidence.time_s[i] - evidence.time_s[i - 1];
    if (turn_rad && std::abs(*turn_rad) > kTurning_rad_s * length_s) usable[i] = false;
  }
  return usable;
}

}  // namespace

std::optional<SegmentTie> tie_by_speed(std::span<const double> time_s, FrameRange run,
                                       std::span<const std::optional<double>> moved,
                                       std::span<const std::optional<double>> tied,
                                       const SegmentTieOptions& options) {
  constexpr double kLeastSigma = 0.05;  // a walk that has never changed its speed may still do so
  const std::size_t lost = last_known(tied, run.begin);
  if (lost == 0) return std::nullopt;
  const double lost_s = time_s[lost - 1], found_s = time_s[run.begin];
  const FrameRange before{seconds_from(time_s, lost_s - options.speed_s, 0).begin + 1, lost};
  const FrameRange after{run.begin, std::min(run.end, seconds_from(time_s, found_s, options.speed_s).end)};
  const auto speed_before = speed_over(time_s, tied, before), speed_after = speed_over(time_s, moved, after);
  if (!speed_before || !speed_after) return std::nullopt;
  const double over_s = found_s - lost_s + options.speed_s;  // from middle to middle
  const double sigma =
      speed_change(time_s, tied, over_s, options.speed_s).value_or(options.usual_speed_sigma);
  return SegmentTie{*speed_before / *speed_after, std::max(sigma, kLeastSigma)};
}

std::optional<SegmentTie> tie_by_relation(const MotionEvidence& evidence, FrameRange run,
                                          std::span<const std::optional<double>> moved,
                                          std::span<const std::optional<double>> tied,
                                          const SegmentTieOptions& options) {
  if (evidence.errors == nullptr) return std::nullopt;
  const FrameRange first{run.begin, run.begin + 1};
  const FrameRange near = frames_around(evidence.time_s, first, options.relation_window_s);
  const FrameRange after{run.begin, std::min(run.end, near.end)};
  const FrameRange before = known_before(tied, run.begin, near.end - run.begin);
  const std::vector<bool> usable = usable_errors(evidence);
  const auto predicted =
      predict_displacement(*evidence.errors, evidence.time_s, usable, tied, before, after, options.relation);
  double by_relation = 0, by_track = 0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const std::size_t frame = after.begin + i;
    if (!usable[frame] || !moved[frame] || !predicted[i]) continue;
    by_relation += *predicted[i];
    by_track += *moved[frame];
  }
  if (!(by_relation > 0 && by_track > 0)) return std::nullopt;
  return SegmentTie{by_relation / by_track, options.relation_sigma};
}

std::optional<SegmentTie> combined(const std::optional<SegmentTie>& a, const std::optional<SegmentTie>& b) {
  if (!a || !b) return a ? a : b;
  const double weight_a = 1 / (a->sigma * a->sigma), weight_b = 1 / (b->sigma * b->sigma);
  const double logarithm =
      (weight_a * std::log(a->scale) + weight_b * std::log(b->scale)) / (weight_a + weight_b);
  return SegmentTie{std::exp(logarithm), 1 / std::sqrt(weight_a + weight_b)};
}

}  // namespace vo
