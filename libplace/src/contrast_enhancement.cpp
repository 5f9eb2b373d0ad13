#include "place/contrast_enhancement.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

/// Below this share of the mean square, a deviation is rounding and taken as none (float inputs carry 24
/// bits).
constexpr double kRounding = 1e-12;

struct Moments {
  double sum = 0;
  double square = 0;

  void add(double value) {
    sum += value;
    square += value * value;
  }
  void remove(double value) {
    sum -= value;
    square -= value * value;
  }
  /// (value - mean) / deviation over `count` values, with `count - freedom` in the variance; 0 where there is
  /// none.
  [[nodiscard]] float standard_score(double value, double count, double freedom) const {
    const double mean = sum / count;
    const double spread = square - sum * mean;
    if (count <= freedom || spread <= kRounding * square) return 0;
    return static_cast<float>((value - mean) / std::sqrt(spread / (count - freedom)));
  }
};

void enhance_locally(CostMatrix& costs, std::size_t half) {
  vo::parallel_for(costs.queries, [&](std::size_t q) {
    const std::span<float> row = costs.row(q);
    const std::vector<float> raw(row.begin(), row.end());
    Moments window;
    std::size_t first = 0, last = 0;  // the window is [first, last)
    for (std::size_t r = 0; r < raw.size(); ++r) {
      while (last < std::min(raw.size(), r + half + 1)) window.add(raw[last++]);
      while (first + half < r) window.remove(raw[first++]);
      row[r] = window.standard_score(raw[r], static_cast<double>(last - first), 1);
    }
  });
}

void standardise_queries(CostMatrix& costs) {
  vo::parallel_for(costs.queries, [&](std::size_t q) {
    const std::span<float> row = costs.row(q);
    Moments moments;
    for (const float value : row) moments.add(value);
    for (float& value : row) value = moments.standard_score(value, static_cast<double>(row.size()), 0);
  });
}

void standardise_references(CostMatrix& costs) {
  constexpr std::size_t kBlock = 64;  // references a thread takes at a time: whole cache lines of every row
  vo::parallel_for((costs.references + kBlock - 1) / kBlock, [&](std::size_t block) {
    const std::size_t begin = block * kBlock;
    const std::size_t count = std::min(kBlock, costs.references - begin);
    std::vector<Moments> moments(count);
    for (std::size_t q = 0; q < costs.queries; ++q) {
      const std::span<float> row = costs.row(q).subspan(begin, count);
      for (std::size_t r = 0; r < count; ++r) moments[r].add(row[r]);
    }
    for (std::size_t q = 0; q < costs.queries; ++q) {
      const std::span<float> row = costs.row(q).subspan(begin, count);
      for (std::size_t r = 0; r < count; ++r) {
        row[r] = moments[r].standard_score(row[r], static_cast<double>(costs.queries), 0);
      }
    }
  });
}

}  // namespace

void enhance_contrast(CostMatrix& costs, const ContrastEnhancementOptions& options) {
  if (options.window < 2) throw std::invalid_argument("enhance_contrast: window must be >= 2");
  switch (options.method) {
    case Enhancement::kNone:
      return;
    case Enhancement::kLocal:
      enhance_locally(costs, static_cast<std::size_t>(options.window / 2));
      return;
    case Enhancement::kStandardise:
      standardise_queries(costs);
      standardise_references(costs);
      return;
  }
}

}  // namespace place
