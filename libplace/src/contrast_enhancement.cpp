#include "place/contrast_enhancement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
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
  /// 1 / deviation over `count` values, with `count - freedom` in the variance; 0 where there is none.
  [[nodiscard]] double inverse_deviation(double count, double freedom) const {
    const double spread = square - sum * (sum / count);
    if (count <= freedom || spread <= kRounding * square) return 0;
    return 1 / std::sqrt(spread / (count - freedom));
  }
};

/// Eight sums of every eighth value, which compilers turn into vectors, and those added up.
Moments moments_of(std::span<const float> values) {
  constexpr std::size_t kLanes = 8;
  std::array<double, kLanes> sum{}, square{};
  const auto add = [&](std::size_t k, double value) {
    sum[k] += value;
    square[k] += value * value;
  };
  const std::size_t whole = values.size() - values.size() % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) add(k, values[i + k]);
  }
  for (std::size_t i = whole; i < values.size(); ++i) add(i - whole, values[i]);
  return {std::accumulate(sum.begin(), sum.end(), 0.0), std::accumulate(square.begin(), square.end(), 0.0)};
}

void enhance_locally(std::span<float> row, std::size_t half) {
  const std::vector<float> raw(row.begin(), row.end());
  Moments window;
  std::size_t first = 0, last = 0;  // the window is [first, last)
  for (std::size_t r = 0; r < raw.size(); ++r) {
    while (last < std::min(raw.size(), r + half + 1)) window.add(raw[last++]);
    while (first + half < r) window.remove(raw[first++]);
    const auto count = static_cast<double>(last - first);
    row[r] = static_cast<float>((raw[r] - window.sum / count) * window.inverse_deviation(count, 1));
  }
}

float standard_score(float value, double mean, double inverse_deviation) {
  return static_cast<float>((value - mean) * inverse_deviation);
}

/// Calls `body(begin, count)` for stretches of the references, in parallel: whole cache lines of every row.
template <typename Body>
void for_each_stretch(std::size_t references, const Body& body) {
  constexpr std::size_t kStretch = 512;
  vo::parallel_for((references + kStretch - 1) / kStretch,
                   [&](std::size_t i) { body(i * kStretch, std::min(kStretch, references - i * kStretch)); });
}

}  // namespace

ContrastEnhancer::ContrastEnhancer(std::size_t queries, std::size_t references,
                                   const ContrastEnhancementOptions& options)
    : queries_(queries), references_(references), options_(options) {
  if (options.window < 2) throw std::invalid_argument("enhance_contrast: window must be >= 2");
  if (options.method != Enhancement::kStandardise) return;
  for (Standard* standard : {&query_, &reference_}) {
    standard->mean.resize(standard == &query_ ? queries : references);
    standard->inverse_deviation.resize(standard->mean.size());
  }
}

void ContrastEnhancer::survey(std::span<const float> rows) {
  const std::size_t count = references_ == 0 ? 0 : rows.size() / references_, first = surveyed_;
  if (count * references_ != rows.size() || count > queries_ - first) {
    throw std::invalid_argument("ContrastEnhancer: whole rows, as many as there are queries, expected");
  }
  surveyed_ += count;
  if (options_.method == Enhancement::kStandardise) {
    vo::parallel_for(count, [&](std::size_t i) {
      const Moments moments = moments_of(rows.subspan(i * references_, references_));
      query_.mean[first + i] = moments.sum / static_cast<double>(references_);
      query_.inverse_deviation[first + i] = moments.inverse_deviation(static_cast<double>(references_), 0);
    });
    survey_references(first, rows);
    if (surveyed_ == queries_) finish_survey();
    return;
  }
  std::vector<CostRange> ranges(count);
  vo::parallel_for(count, [&](std::size_t i) {
    const std::span<const float> row = rows.subspan(i * references_, references_);
    if (options_.method == Enhancement::kNone) {
      ranges[i] = range_of(row);
    } else {
      std::vector<float> enhanced(row.begin(), row.end());
      enhance_locally(enhanced, static_cast<std::size_t>(options_.window / 2));
      ranges[i] = range_of(enhanced);
    }
  });
  for (const CostRange& range : ranges) {
    sum_ += range.centre;
    least_ = std::min(least_, range.centre - range.largest);
    most_ = std::max(most_, range.centre + range.largest);
  }
}

void ContrastEnhancer::survey_references(std::size_t first, std::span<const float> rows) {
  for_each_stretch(references_, [&](std::size_t begin, std::size_t count) {
    double* sum = reference_.mean.data() + begin;
    double* square = reference_.inverse_deviation.data() + begin;
    for (std::size_t i = 0; i * references_ < rows.size(); ++i) {
      const float* row = rows.data() + i * references_ + begin;
      const double mean = query_.mean[first + i], inverse = query_.inverse_deviation[first + i];
      for (std::size_t r = 0; r < count; ++r) {
        const double score = standard_score(row[r], mean, inverse);
        sum[r] += score;
        square[r] += score * score;
      }
    }
  });
}

void ContrastEnhancer::finish_survey() {
  const auto count = static_cast<double>(queries_);
  for (std::size_t r = 0; r < references_; ++r) {
    const Moments moments{reference_.mean[r], reference_.inverse_deviation[r]};
    reference_.mean[r] = moments.sum / count;
    reference_.inverse_deviation[r] = moments.inverse_deviation(count, 0);
  }
}

void ContrastEnhancer::enhance(std::size_t first, std::span<float> rows) const {
  if (options_.method == Enhancement::kNone || rows.empty()) return;
  const std::size_t count = rows.size() / references_;
  if (options_.method == Enhancement::kLocal) {
    vo::parallel_for(count, [&](std::size_t i) {
      enhance_locally(rows.subspan(i * references_, references_),
                      static_cast<std::size_t>(options_.window / 2));
    });
    return;
  }
  for_each_stretch(references_, [&](std::size_t begin, std::size_t stretch) {
    const double* mean = reference_.mean.data() + begin;
    const double* inverse = reference_.inverse_deviation.data() + begin;
    for (std::size_t i = 0; i < count; ++i) {
      float* row = rows.data() + i * references_ + begin;
      const double query_mean = query_.mean[first + i], query_inverse = query_.inverse_deviation[first + i];
      for (std::size_t r = 0; r < stretch; ++r)
        row[r] = standard_score(standard_score(row[r], query_mean, query_inverse), mean[r], inverse[r]);
    }
  });
}

CostRange ContrastEnhancer::range() const {
  if (queries_ == 0 || references_ == 0) return {};
  if (options_.method == Enhancement::kStandardise) {
    // No value of n can be further than sqrt(n - 1) deviations from their mean; one more for rounding.
    return {.centre = 0, .largest = std::sqrt(static_cast<double>(queries_))};
  }
  const double centre = sum_ / static_cast<double>(queries_);
  return {.centre = centre, .largest = std::max(most_ - centre, centre - least_)};
}

void enhance_contrast(CostMatrix& costs, const ContrastEnhancementOptions& options) {
  ContrastEnhancer enhancer(costs.queries, costs.references, options);
  if (costs.values.empty()) return;
  if (options.method == Enhancement::kStandardise) enhancer.survey(costs.values);
  enhancer.enhance(0, costs.values);
}

}  // namespace place
