#include "trajectory/initial_alignment.hpp"

#include <algorithm>
#include <cmath>

namespace place {
namespace {

using pose_graph::State;

struct Point {
  double x_m = 0, y_m = 0;
};

/// A vector turned clockwise.
Point turned(double x_m, double y_m, double by_rad) {
  const double s = std::sin(by_rad), c = std::cos(by_rad);
  return {c * x_m + s * y_m, c * y_m - s * x_m};
}

/// Whether a fix is where another fix and the odometry between them put its node. The tolerance allows for
/// odometry errors, a share of the distance, and for the error of the other match's heading, a few degrees,
/// which turns all of it.
bool agree(const vo::Trajectory& odometry, const PoseFix& a, const PoseFix& b, double way_m) {
  constexpr double kLeast_m = 1, kShare = 0.2;
  const vo::Pose2 &from = odometry[a.node].pose, &to = odometry[b.node].pose;
  const Point step = turned(to.x_m - from.x_m, to.y_m - from.y_m, a.pose.heading_rad - from.heading_rad);
  return std::hypot(a.pose.x_m + step.x_m - b.pose.x_m, a.pose.y_m + step.y_m - b.pose.y_m) <=
         kLeast_m + kShare * way_m;
}

/// The number of neighbours that agree with each fix, in both directions.
std::vector<int> support_of(const vo::Trajectory& odometry, std::span<const double> travelled_m,
                            std::span<const PoseFix> fixes) {
  constexpr double kReach_m = 15;
  constexpr std::size_t kNeighbours = 32;
  std::vector<int> support(fixes.size(), 0);
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(fixes.size(), i + 1 + kNeighbours); ++j) {
      const double way_m = travelled_m[fixes[j].node] - travelled_m[fixes[i].node];
      if (way_m > kReach_m) break;
      if (!agree(odometry, fixes[i], fixes[j], way_m) || !agree(odometry, fixes[j], fixes[i], way_m))
        continue;
      ++support[i];
      ++support[j];
    }
  }
  return support;
}

/// The best supported fix in every few metres, among those with which at least two others agree, and at least
/// half as many as with the best one nearby.
std::vector<std::size_t> anchors_of(const std::vector<int>& support, std::span<const double> travelled_m,
                                    std::span<const PoseFix> fixes) {
  constexpr double kApart_m = 3, kNear_m = 15;
  const auto at_m = [&](std::size_t i) { return travelled_m[fixes[i].node]; };
  std::vector<std::size_t> anchors;
  std::size_t low = 0;
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    while (at_m(i) - at_m(low) > kNear_m) ++low;
    int best = 0;
    for (std::size_t j = low; j < fixes.size() && at_m(j) - at_m(i) <= kNear_m; ++j)
      best = std::max(best, support[j]);
    if (support[i] < 2 || 2 * support[i] < best) continue;
    if (anchors.empty() || at_m(i) - at_m(anchors.back()) >= kApart_m) {
      anchors.push_back(i);
    } else if (support[i] > support[anchors.back()]) {
      anchors.back() = i;
    }
  }
  return anchors;
}

/// A value at each node, interpolated linearly in distance between the given ones, constant beyond them.
class Interpolated {
 public:
  void add(double at_m, double value) {
    at_m_.push_back(at_m);
    value_.push_back(value);
  }
  [[nodiscard]] bool empty() const { return value_.empty(); }
  [[nodiscard]] double last() const { return value_.back(); }
  [[nodiscard]] double at(double at_m) const {
    const auto after = static_cast<std::size_t>(std::ranges::upper_bound(at_m_, at_m) - at_m_.begin());
    if (after == 0) return value_.front();
    if (after == at_m_.size()) return value_.back();
    const double t = (at_m - at_m_[after - 1]) / (at_m_[after] - at_m_[after - 1]);
    return std::lerp(value_[after - 1], value_[after], t);
  }

 private:
  std::vector<double> at_m_, value_;
};

}  // namespace

std::vector<State> unaligned(const vo::Trajectory& odometry) {
  std::vector<State> states;
  double heading = odometry.empty() ? 0 : odometry.front().pose.heading_rad;
  for (const vo::TimedPose& node : odometry) {
    heading += vo::wrap_angle_rad(node.pose.heading_rad - heading);
    states.push_back({{node.pose.x_m, node.pose.y_m, heading, 0, 0, 0}});
  }
  return states;
}

std::vector<State> initial_alignment(const vo::Trajectory& odometry, std::span<const double> travelled_m,
                                     std::span<const PoseFix> fixes) {
  const std::vector<std::size_t> anchors =
      anchors_of(support_of(odometry, travelled_m, fixes), travelled_m, fixes);
  if (anchors.empty()) return {};
  std::vector<State> states = unaligned(odometry);

  Interpolated turn;
  for (const std::size_t i : anchors) {
    const double heading = states[fixes[i].node].value[State::kHeading];
    const double before = turn.empty() ? 0 : turn.last();
    turn.add(travelled_m[fixes[i].node],
             before + vo::wrap_angle_rad(fixes[i].pose.heading_rad - heading - before));
  }
  for (std::size_t i = 0; i < states.size(); ++i) states[i].value[State::kHeading] += turn.at(travelled_m[i]);
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    const vo::Pose2 &a = odometry[i].pose, &b = odometry[i + 1].pose;
    const double by_rad = (turn.at(travelled_m[i]) + turn.at(travelled_m[i + 1])) / 2;
    const Point step = turned(b.x_m - a.x_m, b.y_m - a.y_m, by_rad);
    states[i + 1].value[State::kX] = states[i].value[State::kX] + step.x_m;
    states[i + 1].value[State::kY] = states[i].value[State::kY] + step.y_m;
  }

  Interpolated x, y;
  for (const std::size_t i : anchors) {
    const State& state = states[fixes[i].node];
    x.add(travelled_m[fixes[i].node], fixes[i].pose.x_m - state.value[State::kX]);
    y.add(travelled_m[fixes[i].node], fixes[i].pose.y_m - state.value[State::kY]);
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].value[State::kX] += x.at(travelled_m[i]);
    states[i].value[State::kY] += y.at(travelled_m[i]);
  }
  return states;
}

}  // namespace place
