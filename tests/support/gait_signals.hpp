#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <vo/base/rng.hpp>

namespace test_support {

/// A made-up orientation signal, 25 frames a second, put together piece by piece, and the steps in it.
class GaitSignal {
 public:
  static constexpr double kRate_hz = 25;

  explicit GaitSignal(std::uint64_t seed = 1) : rng_(seed) {}

  /// Walks so many steps: half a wave each, the first half up, with the shoulder before each peak that a
  /// second harmonic makes.
  GaitSignal& walk(int steps, double step_hz, double amplitude_deg, double noise_deg = 0) {
    const int frames = static_cast<int>(std::lround(steps / step_hz * kRate_hz));
    for (int i = 0; i < frames; ++i) {
      const double phase = std::numbers::pi * steps * (i + 0.5) / frames;
      push(amplitude_deg * (std::sin(phase) + 0.2 * std::sin(2 * phase + 1)) + noise_deg * rng_.normal(),
           true);
    }
    steps_ += steps;
    return *this;
  }

  /// Stands: breathing at 0.25 Hz, and noise.
  GaitSignal& stand(double seconds, double breathing_deg, double noise_deg = 0) {
    return add(seconds, true, [&](double s) {
      return breathing_deg * std::sin(2 * std::numbers::pi * 0.25 * s) + noise_deg * rng_.normal();
    });
  }

  /// Noise where nothing was measured, told or untold.
  GaitSignal& blank(double seconds, double noise_deg, bool reliable) {
    return add(seconds, reliable, [&](double) { return noise_deg * rng_.normal(); });
  }

  [[nodiscard]] const std::vector<double>& deg() const { return deg_; }
  [[nodiscard]] const std::vector<double>& time_s() const { return time_s_; }
  [[nodiscard]] const std::vector<bool>& reliable() const { return reliable_; }
  [[nodiscard]] int steps() const { return steps_; }

 private:
  template <typename Value>
  GaitSignal& add(double seconds, bool reliable, const Value& value) {
    const auto frames = std::lround(seconds * kRate_hz);
    for (long i = 0; i < frames; ++i) push(value(static_cast<double>(i) / kRate_hz), reliable);
    return *this;
  }
  void push(double deg, bool reliable) {
    time_s_.push_back(static_cast<double>(deg_.size()) / kRate_hz);
    deg_.push_back(deg);
    reliable_.push_back(reliable);
  }

  vo::Rng rng_;
  std::vector<double> deg_, time_s_;
  std::vector<bool> reliable_;
  int steps_ = 0;
};

}  // namespace test_support
