#include "place/evaluation/odometry_evaluation.hpp"

#include "vo/base/rng.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace place {
namespace {

/// Allowed difference of the clocks of truth and estimate at the ends: about a frame.
constexpr double kClockTolerance_s = 0.05;

vo::Pose2 between(const vo::Pose2& a, const vo::Pose2& b, double t) {
  return {std::lerp(a.x_m, b.x_m, t), std::lerp(a.y_m, b.y_m, t),
          vo::wrap_angle_rad(a.heading_rad + t * vo::wrap_angle_rad(b.heading_rad - a.heading_rad))};
}

/// The pair at a distance within the range of pairs.
PosePair pair_at(std::span<const PosePair> pairs, double distance_m) {
  const auto after = std::ranges::lower_bound(pairs, distance_m, {}, &PosePair::distance_m);
  if (after == pairs.begin()) return pairs.front();
  if (after == pairs.end()) return pairs.back();
  const PosePair& a = *std::prev(after);
  const double t = (distance_m - a.distance_m) / (after->distance_m - a.distance_m);
  return {distance_m, between(a.truth, after->truth, t), between(a.estimate, after->estimate, t)};
}

/// The estimate's pose after aligning it with the truth at the start.
vo::Pose2 reset(const vo::Pose2& estimate, const PosePair& start) {
  const double turn = start.truth.heading_rad - start.estimate.heading_rad;  // clockwise
  const double x = estimate.x_m - start.estimate.x_m, y = estimate.y_m - start.estimate.y_m;
  return {start.truth.x_m + x * std::cos(turn) + y * std::sin(turn),
          start.truth.y_m - x * std::sin(turn) + y * std::cos(turn),
          vo::wrap_angle_rad(estimate.heading_rad + turn)};
}

struct Moments {
  double mean = 0, sd = 0;
};

Moments moments(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  Moments m{.mean = std::accumulate(values.begin(), values.end(), 0.0) / count};
  double squares = 0;
  for (const double value : values) squares += (value - m.mean) * (value - m.mean);
  if (values.size() > 1) m.sd = std::sqrt(squares / (count - 1));
  return m;
}

/// Sums the measurements up.
void sum_up(OdometryErrors& errors) {
  errors.count = errors.euclidean_m.size();
  const Moments e = moments(errors.euclidean_m), h = moments(errors.heading_deg);
  errors.euclidean_mean_m = e.mean;
  errors.euclidean_sd_m = e.sd;
  errors.heading_mean_deg = h.mean;
  errors.heading_sd_deg = h.sd;
  std::vector<double> sizes_deg;
  for (const double error : errors.heading_deg) sizes_deg.push_back(std::abs(error));
  errors.heading_abs_mean_deg = moments(sizes_deg).mean;
}

void check(std::span<const PosePair> pairs, const OdometryEvaluationOptions& options) {
  const auto no_less = [](double a, double b) { return !(a < b); };
  if (std::ranges::adjacent_find(pairs, no_less, &PosePair::distance_m) != pairs.end())
    throw std::invalid_argument("evaluate_odometry: pairs by increasing distance expected");
  if (!(options.segment_m > 0)) throw std::invalid_argument("evaluate_odometry: segment_m above 0 expected");
  const std::vector<double>& at_m = options.at_m;
  if (at_m.empty() || !(at_m.front() > 0) || std::ranges::adjacent_find(at_m, no_less) != at_m.end())
    throw std::invalid_argument("evaluate_odometry: at_m increasing from above 0 expected");
}

}  // namespace

std::vector<PosePair> pair_by_time(const vo::Trajectory& truth, std::span<const double> distance_m,
                                   const vo::Trajectory& estimate) {
  if (distance_m.size() != truth.size())
    throw std::invalid_argument("pair_by_time: one distance per true pose expected");
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!pairs.empty() && distance_m[i] <= pairs.back().distance_m) continue;
    const std::optional<vo::Pose2> pose = vo::pose_at(estimate, truth[i].time_s, kClockTolerance_s);
    if (pose) pairs.push_back({distance_m[i], truth[i].pose, *pose});
  }
  return pairs;
}

std::vector<PosePair> pair_by_share(std::span<const MapPoint> path, const vo::Trajectory& estimate) {
  // Legs of the path that have a length, and the distance at which each begins.
  struct Leg {
    double begin_m, length_m;
    MapPoint from, to;
  };
  std::vector<Leg> legs;
  double path_m = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length_m = std::hypot(path[i].x_m - path[i - 1].x_m, path[i].y_m - path[i - 1].y_m);
    if (length_m > 0) legs.push_back({path_m, length_m, path[i - 1], path[i]});
    path_m += length_m;
  }
  if (legs.empty()) throw std::invalid_argument("pair_by_share: a path with a length expected");

  std::vector<double> travelled_m(estimate.size(), 0);
  for (std::size_t i = 1; i < estimate.size(); ++i) {
    const vo::Pose2 &a = estimate[i - 1].pose, &b = estimate[i].pose;
    travelled_m[i] = travelled_m[i - 1] + std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  }
  std::vector<PosePair> pairs;
  if (estimate.empty() || travelled_m.back() == 0) return pairs;
  std::size_t leg = 0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const double distance_m = path_m * travelled_m[i] / travelled_m.back();
    if (!pairs.empty() && distance_m <= pairs.back().distance_m) continue;
    while (leg + 1 < legs.size() && distance_m >= legs[leg + 1].begin_m) ++leg;
    const auto& [begin_m, length_m, from, to] = legs[leg];
    const double t = (distance_m - begin_m) / length_m;
    pairs.push_back({distance_m,
                     {std::lerp(from.x_m, to.x_m, t), std::lerp(from.y_m, to.y_m, t),
                      std::atan2(to.x_m - from.x_m, to.y_m - from.y_m)},
                     estimate[i].pose});
  }
  return pairs;
}

OdometryEvaluation evaluate_odometry(std::span<const PosePair> pairs,
                                     const OdometryEvaluationOptions& options) {
  check(pairs, options);
  OdometryEvaluation result;
  if (!pairs.empty()) result.distance_m = pairs.back().distance_m - pairs.front().distance_m;
  result.segment_m = options.segment_m;
  if (result.distance_m < options.segment_m) {
    const auto beyond = std::ranges::upper_bound(options.at_m, result.distance_m);
    result.segment_m = beyond == options.at_m.begin() ? 0 : *std::prev(beyond);
  }

  std::vector<PosePair> starts;
  vo::Rng rng(options.seed);
  for (std::size_t i = 0; i < options.segments && result.segment_m > 0; ++i) {
    const double room_m = result.distance_m - result.segment_m;
    starts.push_back(pair_at(pairs, pairs.front().distance_m + rng.uniform() * room_m));
  }
  for (const double at_m : options.at_m) {
    OdometryErrors errors{.at_m = at_m};
    for (const PosePair& start : starts) {
      if (at_m > result.segment_m) break;
      const PosePair there = pair_at(pairs, start.distance_m + at_m);
      const vo::Pose2 estimate = reset(there.estimate, start);
      errors.euclidean_m.push_back(
          std::hypot(estimate.x_m - there.truth.x_m, estimate.y_m - there.truth.y_m));
      errors.heading_deg.push_back(vo::wrap_angle_rad(there.truth.heading_rad - estimate.heading_rad) * 180 /
                                   std::numbers::pi);
    }
    sum_up(errors);
    result.errors.push_back(errors);
  }
  return result;
}

OdometryEvaluation pooled(std::span<const OdometryEvaluation> walks) {
  if (walks.empty()) throw std::invalid_argument("pooled: a walk expected");
  OdometryEvaluation all = walks.front();
  for (const OdometryEvaluation& walk : walks.subspan(1)) {
    if (!std::ranges::equal(walk.errors, all.errors, {}, &OdometryErrors::at_m, &OdometryErrors::at_m))
      throw std::invalid_argument("pooled: walks measured at the same distances expected");
    all.distance_m += walk.distance_m;
    all.segment_m = std::max(all.segment_m, walk.segment_m);
    for (std::size_t i = 0; i < all.errors.size(); ++i) {
      const OdometryErrors& more = walk.errors[i];
      OdometryErrors& errors = all.errors[i];
      errors.euclidean_m.insert(errors.euclidean_m.end(), more.euclidean_m.begin(), more.euclidean_m.end());
      errors.heading_deg.insert(errors.heading_deg.end(), more.heading_deg.begin(), more.heading_deg.end());
    }
  }
  for (OdometryErrors& errors : all.errors) sum_up(errors);
  return all;
}

StepErrors step_errors(std::span<const StepCount> walks) {
  std::vector<double> errors, sizes, truths;
  for (const StepCount& walk : walks) {
    truths.push_back(static_cast<double>(walk.truth));
    errors.push_back(static_cast<double>(walk.estimated) - truths.back());
    sizes.push_back(std::abs(errors.back()));
  }
  const double true_mean = moments(truths).mean;
  if (!(true_mean > 0)) throw std::invalid_argument("step_errors: true steps expected");
  const Moments error = moments(errors), size = moments(sizes);
  return {error.mean, error.sd, size.mean, size.sd, 100 * size.mean / true_mean};
}

}  // namespace place
