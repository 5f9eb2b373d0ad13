#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <vo/base/rng.hpp>

namespace test_support {

/// The bounce and the growth of a picture, 25 frames a second, put together piece by piece. The picture moves
/// up fastest at the end of each step; while one walks it grows by 1 % a frame.
class BouncingWalk {
 public:
  static constexpr double kRate_hz = 25;

  /// `phase`: share of a step that was made before.
  explicit BouncingWalk(double phase = 0) : phase_(phase) {}

  /// Goes on for so many steps, which need not be whole, where the last piece left off.
  BouncingWalk& walk(double steps, double step_hz, double bounce_px = 2, double growth = 0.01) {
    const auto frames = std::lround(steps / step_hz * kRate_hz);
    for (long i = 0; i < frames; ++i) {
      phase_ += steps / static_cast<double>(frames);
      push(-bounce_px * std::cos(2 * std::numbers::pi * phase_), growth, true);
    }
    return *this;
  }

  /// Stands: the picture sways a little at the rate of steps, and does not grow.
  BouncingWalk& stand(double seconds, double sway_px = 0) {
    return still(seconds, [&](double s) { return sway_px * std::sin(2 * std::numbers::pi * 1.3 * s); });
  }

  /// The picture shows nothing, while it grows as before: what `bridge_gaps` makes of a dark stretch.
  BouncingWalk& dark(double steps, double step_hz) {
    const auto frames = std::lround(steps / step_hz * kRate_hz);
    for (long i = 0; i < frames; ++i) push(0, 0.01, false);
    phase_ += steps;
    return *this;
  }

  [[nodiscard]] const std::vector<double>& bounce_px() const { return bounce_px_; }
  [[nodiscard]] const std::vector<double>& growth() const { return growth_; }
  [[nodiscard]] const std::vector<double>& time_s() const { return time_s_; }
  [[nodiscard]] const std::vector<bool>& reliable() const { return reliable_; }

  /// Steps that were completed.
  [[nodiscard]] std::size_t steps() const { return static_cast<std::size_t>(phase_ + 1e-6); }

 private:
  template <typename Value>
  BouncingWalk& still(double seconds, const Value& value) {
    const auto frames = std::lround(seconds * kRate_hz);
    for (long i = 0; i < frames; ++i) push(value(static_cast<double>(i) / kRate_hz), 0, true);
    return *this;
  }
  void push(double bounce_px, double growth, bool reliable) {
    time_s_.push_back(static_cast<double>(time_s_.size()) / kRate_hz);
    bounce_px_.push_back(bounce_px + 0.02 * rng_.normal());
    growth_.push_back(growth);
    reliable_.push_back(reliable);
  }

  vo::Rng rng_{1};
  double phase_;
  std::vector<double> bounce_px_, growth_, time_s_;
  std::vector<bool> reliable_;
};

}  // namespace test_support
