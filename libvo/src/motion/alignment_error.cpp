#include "vo/motion/alignment_error.hpp"

#include "vo/base/clock.hpp"
#include "vo/base/median.hpp"
#include "vo/base/parallel.hpp"
#include "vo/image/patch_normalisation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace vo {
namespace {

bool is_excluded(const std::vector<bool>& excluded, std::size_t frame) {
  return !excluded.empty() && excluded[frame];
}

void check(const AlignmentErrors& errors, const std::vector<bool>& excluded) {
  if (!excluded.empty() && excluded.size() != errors.frames())
    throw std::invalid_argument("alignment errors: one flag per frame expected");
}

/// Sum and number of the errors of one span.
struct Sum {
  double error = 0;
  double seconds = 0;
  double count = 0;
};

Sum sum_of(const std::vector<Comparison>& comparisons, const std::vector<bool>& excluded) {
  Sum sum;
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    if (!comparisons[i].made() || is_excluded(excluded, i)) continue;
    sum.error += comparisons[i].error;
    sum.seconds += comparisons[i].seconds;
    ++sum.count;
  }
  return sum;
}

/// The error of each frame as a multiple of the usual one; a frame that was not compared gets its
/// neighbour's.
std::vector<double> relative_errors(const AlignmentErrors& errors, const std::vector<bool>& excluded) {
  std::vector<double> usual;
  for (const auto& comparisons : errors.by_span) {
    const Sum sum = sum_of(comparisons, excluded);
    usual.push_back(sum.count > 0 ? sum.error / sum.count : 0);
  }
  std::vector<double> relative(errors.frames(), 0);
  for (std::size_t i = 0; i < relative.size(); ++i) {
    double found = 0, expected = 0;
    for (std::size_t k = 0; k < errors.spans(); ++k) {
      if (!errors.by_span[k][i].made()) continue;
      found += errors.by_span[k][i].error;
      expected += usual[k];
    }
    relative[i] = expected > 0 ? found / expected : (i > 0 ? relative[i - 1] : 0);
  }
  return relative;
}

}  // namespace

double alignment_error(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  if (a.size() != b.size() || a.empty())
    throw std::invalid_argument("alignment_error: two images of one size expected");
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += static_cast<std::uint32_t>(std::abs(a[k] - b[k]));
  return sum / (kStepsPerDeviation * static_cast<double>(a.size()));
}

AlignmentErrors alignment_errors(const ImageStack& normalised, std::span<const double> time_s,
                                 const AlignmentErrorOptions& options) {
  if (options.spans < 1) throw std::invalid_argument("alignment_errors: at least one span expected");
  if (time_s.size() != normalised.size())
    throw std::invalid_argument("alignment_errors: one time per frame expected");
  const std::size_t frames = normalised.size();
  AlignmentErrors errors;
  errors.by_span.assign(options.spans, std::vector<Comparison>(frames));
  if (frames < 2) return errors;
  const double span_s = std::max(kAlignmentSpan_s, 0.5 / frame_rate_hz(time_s));
  // Times are rounded to milliseconds; of two equally near frames, the earlier.
  const double reach_s = span_s / 2 + 1e-4;
  parallel_for(frames, [&](std::size_t i) {
    std::size_t later = i + 1;
    for (std::size_t k = 0; k < options.spans; ++k) {
      const double at_s = time_s[i] + static_cast<double>(k + 1) * span_s;
      while (later + 1 < frames && at_s - time_s[later] > time_s[later + 1] - at_s + 1e-6) ++later;
      if (later >= frames || std::abs(time_s[later] - at_s) > reach_s) continue;
      errors.by_span[k][i] = {.frames = static_cast<std::uint32_t>(later - i),
                              .seconds = static_cast<float>(time_s[later] - time_s[i]),
                              .error = static_cast<float>(alignment_error(normalised[i], normalised[later]))};
    }
  });
  return errors;
}

MeanErrors mean_errors(const AlignmentErrors& errors, const std::vector<bool>& excluded) {
  check(errors, excluded);
  MeanErrors means{.seconds = {0}, .error = {0}};
  for (const auto& comparisons : errors.by_span) {
    const Sum sum = sum_of(comparisons, excluded);
    // Where frames are as far apart as a span and a half, two spans compare the same ones: once is enough.
    constexpr double kLeastApart_s = kAlignmentSpan_s / 4;
    if (!(sum.count > 0) || sum.seconds / sum.count < means.seconds.back() + kLeastApart_s) continue;
    means.seconds.push_back(sum.seconds / sum.count);
    means.error.push_back(sum.error / sum.count);
  }
  return means;
}

ErrorCourse error_course(const AlignmentErrors& errors, std::span<const double> time_s,
                         const std::vector<bool>& excluded, const AlignmentErrorOptions& options) {
  const std::size_t frames = errors.frames();
  if (time_s.size() != frames) throw std::invalid_argument("error_course: one time per frame expected");
  check(errors, excluded);

  ErrorCourse course{.relative = relative_errors(errors, excluded),
                     .smoothed = std::vector<double>(frames),
                     .limit = std::numeric_limits<double>::infinity()};
  std::vector<double> counted;
  double sum = 0, count = 0;
  for (std::size_t i = 0, first = 0, last = 0; i < frames; ++i) {
    const auto add = [&](std::size_t frame, double sign) {
      if (is_excluded(excluded, frame)) return;
      sum += sign * course.relative[frame];
      count += sign;
    };
    while (last < frames && time_s[last] <= time_s[i] + options.smoothing_s / 2) add(last++, 1);
    while (time_s[first] < time_s[i] - options.smoothing_s / 2) add(first++, -1);
    if (is_excluded(excluded, i)) continue;
    course.smoothed[i] = sum / count;
    counted.push_back(course.smoothed[i]);
  }
  if (counted.empty()) return course;

  const double centre = median(counted);
  std::vector<double> deviations(counted.size());
  std::ranges::transform(counted, deviations.begin(), [&](double value) { return std::abs(value - centre); });
  course.limit = centre + options.high_error_mads * median(deviations);
  return course;
}

std::vector<bool> high_error_windows(const AlignmentErrors& errors, std::span<const double> time_s,
                                     const std::vector<bool>& excluded,
                                     const AlignmentErrorOptions& options) {
  const ErrorCourse course = error_course(errors, time_s, excluded, options);
  std::vector<bool> high(errors.frames());
  for (std::size_t i = 0; i < high.size(); ++i)
    high[i] = !is_excluded(excluded, i) && course.smoothed[i] > course.limit;
  return high;
}

}  // namespace vo
