#pragma once

#include "trajectory/pose_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

/// The residuals of a pose graph, in standard deviations, as Ceres differentiates them: each is called with
/// the values of a `State` for every node it connects.
namespace place::pose_graph {

inline constexpr int kCount = State::kCount;
using Vector = Eigen::Matrix<double, kCount, 1>;
using Matrix = Eigen::Matrix<double, kCount, kCount>;

/// A vector in the frame of a walker facing `heading`: forward, right.
template <typename T>
std::array<T, 2> seen_from(const T& heading, const T& x, const T& y) {
  using std::cos, std::sin;
  const T s = sin(heading), c = cos(heading);
  return {s * x + c * y, c * x - s * y};
}

/// The angle near 0 that differs from `angle` by whole turns.
template <typename T>
T wrapped(const T& angle) {
  using std::atan2, std::cos, std::sin;
  return atan2(sin(angle), cos(angle));
}

struct MotionError {
  Motion motion;
  double forward_sd, right_sd, turn_sd, step_scale_sd, bias_sd, turn_scale_sd;

  MotionError(const Motion& m, const DriftCorrectionOptions& o) : motion(m) {
    // Nodes at one place: a walker who is still may turn, and the scales do not change.
    constexpr double kLeast_m = 0.05;
    const double root_m = std::sqrt(std::max(m.distance_m, kLeast_m));
    forward_sd = std::hypot(o.step_noise_m * root_m, o.node_noise_m);
    right_sd = std::hypot(o.side_noise_m * root_m, o.node_noise_m);
    turn_sd = std::hypot(o.turn_noise_rad * root_m, o.node_noise_rad);
    step_scale_sd = o.step_scale_walk * root_m;
    bias_sd = o.bias_walk_rad_per_m * root_m;
    turn_scale_sd = o.turn_scale_walk * root_m;
    if (m.known) return;
    constexpr double kAnywhere_m = 1000, kAnyTurn_rad = 3;
    forward_sd = right_sd = kAnywhere_m;
    turn_sd = kAnyTurn_rad;
  }

  template <typename T>
  bool operator()(const T* a, const T* b, T* r) const {
    using std::exp;
    const T middle = (a[State::kHeading] + b[State::kHeading]) * 0.5;
    const auto [forward, right] =
        seen_from<T>(middle, b[State::kX] - a[State::kX], b[State::kY] - a[State::kY]);
    const T scale = exp(b[State::kStepScale]);
    r[0] = (forward - scale * motion.forward_m) / forward_sd;
    r[1] = (right - scale * motion.right_m) / right_sd;
    r[2] = (b[State::kHeading] - a[State::kHeading] - exp(b[State::kTurnScale]) * motion.turn_rad -
            b[State::kBias] * motion.distance_m) /
           turn_sd;
    r[3] = (b[State::kStepScale] - a[State::kStepScale]) / step_scale_sd;
    r[4] = (b[State::kBias] - a[State::kBias]) / bias_sd;
    r[5] = (b[State::kTurnScale] - a[State::kTurnScale]) / turn_scale_sd;
    return true;
  }
};

/// Along and across the earlier walker's path; `factor` is the root of the weight.
struct PlaceError {
  double along_sd, across_sd;
  const double* factor;

  template <typename T>
  bool scaled(const T& heading, const T& x, const T& y, T* r) const {
    const auto [along, across] = seen_from<T>(heading, x, y);
    r[0] = along * (*factor / along_sd);
    r[1] = across * (*factor / across_sd);
    return true;
  }
};

struct FixError : PlaceError {
  vo::Pose2 pose;
  template <typename T>
  bool operator()(const T* a, T* r) const {
    return scaled(T(pose.heading_rad), a[State::kX] - pose.x_m, a[State::kY] - pose.y_m, r);
  }
};

struct LoopError : PlaceError {
  template <typename T>
  bool operator()(const T* before, const T* now, T* r) const {
    return scaled(before[State::kHeading], now[State::kX] - before[State::kX],
                  now[State::kY] - before[State::kY], r);
  }
};

struct HeadingError {
  double sd;
  const double* factor;
  double heading_rad = 0;

  template <typename T>
  bool operator()(const T* a, T* r) const {
    r[0] = wrapped(T(a[State::kHeading] - heading_rad)) * (*factor / sd);
    return true;
  }
  template <typename T>
  bool operator()(const T* before, const T* now, T* r) const {
    r[0] = wrapped(T(now[State::kHeading] - before[State::kHeading])) * (*factor / sd);
    return true;
  }
};

struct PriorError {
  Matrix root;  // root' root = information
  Vector mean;

  template <typename T>
  bool operator()(const T* a, T* r) const {
    const Eigen::Map<const Eigen::Matrix<T, kCount, 1>> state(a);
    Eigen::Map<Eigen::Matrix<T, kCount, 1>> residual(r);
    residual = root.cast<T>() * (state - mean.cast<T>());
    return true;
  }
};

}  // namespace place::pose_graph
