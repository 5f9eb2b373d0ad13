#pragma once

#include <cmath>

namespace place {

/// Below this share of the mean square, a deviation is rounding error and counts as none (float inputs carry
/// 24 bits).
inline constexpr double kMomentRounding = 1e-12;

struct CostMoments {
  double sum = 0;
  double square = 0;

  void add(const CostMoments& more) {
    sum += more.sum;
    square += more.square;
  }
  void add(double value) {
    sum += value;
    square += value * value;
  }
  void remove(double value) {
    sum -= value;
    square -= value * value;
  }
  /// 1 / deviation over `count` values, with `count - freedom` in the variance; 0 where there is none.
  [[nodiscard]] double inverse_deviation(double count, double freedom) const {
    const double spread = square - sum * (sum / count);
    if (count <= freedom || spread <= kMomentRounding * square) return 0;
    return 1 / std::sqrt(spread / (count - freedom));
  }
};

}  // namespace place
