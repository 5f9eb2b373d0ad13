#include "place/evaluation/trajectory_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <vo/base/median.hpp>

namespace place {
namespace {

/// Index of the pose nearest in time; of two equally near, the earlier.
std::size_t nearest(const vo::Trajectory& trajectory, double time_s) {
  const auto after = std::ranges::lower_bound(trajectory, time_s, {}, &vo::TimedPose::time_s);
  const auto index = static_cast<std::size_t>(after - trajectory.begin());
  if (index == 0) return 0;
  if (index == trajectory.size()) return index - 1;
  return time_s - trajectory[index - 1].time_s <= after->time_s - time_s ? index - 1 : index;
}

/// Rotates, scales and translates: scale * R(turn clockwise) p + shift.
struct Similarity {
  double turn_rad = 0, scale = 1, x_m = 0, y_m = 0;

  [[nodiscard]] vo::Pose2 operator()(const vo::Pose2& p) const {
    const double s = std::sin(turn_rad), c = std::cos(turn_rad);
    return {scale * (c * p.x_m + s * p.y_m) + x_m, scale * (c * p.y_m - s * p.x_m) + y_m,
            p.heading_rad + turn_rad};
  }
};

/// Umeyama's least squares in the plane, where the rotation has a closed form.
Similarity umeyama(const std::vector<vo::Pose2>& from, const std::vector<vo::Pose2>& to, bool scaled) {
  const auto count = static_cast<double>(from.size());
  double fx = 0, fy = 0, tx = 0, ty = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    fx += from[i].x_m / count;
    fy += from[i].y_m / count;
    tx += to[i].x_m / count;
    ty += to[i].y_m / count;
  }
  double along = 0, across = 0, spread = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double ax = from[i].x_m - fx, ay = from[i].y_m - fy, bx = to[i].x_m - tx, by = to[i].y_m - ty;
    along += ax * bx + ay * by;
    across += ay * bx - ax * by;  // clockwise
    spread += ax * ax + ay * ay;
  }
  Similarity s{.turn_rad = std::atan2(across, along)};
  if (scaled && spread > 0) s.scale = std::hypot(along, across) / spread;
  const vo::Pose2 mean = s({fx, fy, 0});
  s.x_m = tx - mean.x_m;
  s.y_m = ty - mean.y_m;
  return s;
}

ErrorStatistics statistics(const std::vector<double>& errors) {
  if (errors.empty()) return {};
  const auto count = static_cast<double>(errors.size());
  ErrorStatistics s{
      .median = vo::median(errors), .min = std::ranges::min(errors), .max = std::ranges::max(errors)};
  for (const double e : errors) {
    s.sse += e * e;
    s.mean += e / count;
  }
  s.rmse = std::sqrt(s.sse / count);
  for (const double e : errors) s.sd += (e - s.mean) * (e - s.mean) / count;
  s.sd = std::sqrt(s.sd);
  return s;
}

/// The translation of a^-1 b, in a's forward and right.
vo::Pose2 relative(const vo::Pose2& a, const vo::Pose2& b) {
  const double x = b.x_m - a.x_m, y = b.y_m - a.y_m;
  const double s = std::sin(a.heading_rad), c = std::cos(a.heading_rad);
  return {c * x - s * y, s * x + c * y, b.heading_rad - a.heading_rad};
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> pair_poses(const vo::Trajectory& estimate,
                                                            const vo::Trajectory& truth,
                                                            double max_time_difference_s) {
  if (!(max_time_difference_s >= 0))
    throw std::invalid_argument("pair_poses: max_time_difference_s must be >= 0");
  const bool truth_is_longer = truth.size() >= estimate.size();
  const vo::Trajectory& shorter = truth_is_longer ? estimate : truth;
  const vo::Trajectory& longer = truth_is_longer ? truth : estimate;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < shorter.size(); ++i) {
    const std::size_t j = nearest(longer, shorter[i].time_s);
    if (std::abs(longer[j].time_s - shorter[i].time_s) > max_time_difference_s) continue;
    pairs.push_back(truth_is_longer ? std::pair(i, j) : std::pair(j, i));
  }
  return pairs;
}

TrajectoryEvaluation evaluate_trajectory(const vo::Trajectory& estimate, const vo::Trajectory& truth,
                                         const TrajectoryEvaluationOptions& options) {
  if (options.delta == 0) throw std::invalid_argument("evaluate_trajectory: delta must be 1 or more");
  std::vector<vo::Pose2> p, q;  // estimated and true, as in the paper
  for (const auto& [i, j] : pair_poses(estimate, truth, options.max_time_difference_s)) {
    p.push_back(estimate[i].pose);
    q.push_back(truth[j].pose);
  }
  TrajectoryEvaluation result;
  result.poses = p.size();
  if (p.size() < 2) return result;
  if (options.alignment != TrajectoryAlignment::kNone) {
    const Similarity align = umeyama(p, q, options.alignment == TrajectoryAlignment::kScaled);
    for (vo::Pose2& pose : p) pose = align(pose);
  }
  std::vector<double> absolute, moved;
  for (std::size_t i = 0; i < p.size(); ++i)
    absolute.push_back(std::hypot(p[i].x_m - q[i].x_m, p[i].y_m - q[i].y_m));
  for (std::size_t i = 0; i + options.delta < p.size(); i += options.delta) {
    const vo::Pose2 estimated = relative(p[i], p[i + options.delta]),
                    real = relative(q[i], q[i + options.delta]);
    moved.push_back(std::hypot(estimated.x_m - real.x_m, estimated.y_m - real.y_m));
  }
  result.end_error_m = absolute.back();
  result.ape_m = statistics(absolute);
  result.rpe_m = statistics(moved);
  return result;
}

}  // namespace place
