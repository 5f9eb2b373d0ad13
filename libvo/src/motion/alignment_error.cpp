#include "vo/motion/alignment_error.hpp"

#include "vo/base/median.hpp"
#include "vo/base/parallel.hpp"
#include "vo/image/patch_normalisation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace vo {
double alignment_error(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  if (a.size() != b.size() || a.empty())
    throw std::invalid_argument("alignment_error: two images of one size expected");
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += static_cast<std::uint32_t>(std::abs(a[k] - b[k]));
  return sum / (kStepsPerDeviation * static_cast<double>(a.size()));
}

AlignmentErrors alignment_errors(const ImageStack& normalised, const AlignmentErrorOptions& options) {
  if (options.max_separation < 1)
    throw std::invalid_argument("alignment_errors: max_separation must be >= 1");
  const std::size_t frames = normalised.size();
  AlignmentErrors errors;
  for (std::size_t s = 0; s <= static_cast<std::size_t>(options.max_separation); ++s) {
    errors.by_separation.emplace_back(frames > s ? frames - s : 0, 0.0F);
  }
  parallel_for(frames, [&](std::size_t i) {
    for (std::size_t s = 1; s < errors.by_separation.size() && i + s < frames; ++s) {
      errors.by_separation[s][i] = static_cast<float>(alignment_error(normalised[i], normalised[i + s]));
    }
  });
  return errors;
}

std::vector<bool> high_error_windows(const AlignmentErrors& errors, std::span<const double> time_s,
                                     const AlignmentErrorOptions& options) {
  const std::size_t frames = errors.frames();
  if (time_s.size() != frames) throw std::invalid_argument("high_error_windows: one time per frame expected");
  if (frames == 0) return {};

  std::vector<double> per_frame(frames, 0.0);
  for (std::size_t i = 0; i < frames; ++i) {
    std::size_t count = 0;
    for (std::size_t s = 1; s < errors.by_separation.size() && i + s < frames; ++s, ++count) {
      per_frame[i] += errors.by_separation[s][i];
    }
    // The last frame has no successor; it is as its neighbour.
    per_frame[i] = count > 0 ? per_frame[i] / static_cast<double>(count) : (i > 0 ? per_frame[i - 1] : 0);
  }

  std::vector<double> smoothed(frames);
  double sum = 0;
  for (std::size_t i = 0, first = 0, last = 0; i < frames; ++i) {
    while (last < frames && time_s[last] <= time_s[i] + options.smoothing_s / 2) sum += per_frame[last++];
    while (time_s[first] < time_s[i] - options.smoothing_s / 2) sum -= per_frame[first++];
    smoothed[i] = sum / static_cast<double>(last - first);
  }

  const double centre = median(smoothed);
  std::vector<double> deviations(frames);
  std::ranges::transform(smoothed, deviations.begin(),
                         [&](double value) { return std::abs(value - centre); });
  const double limit = centre + options.high_error_mads * median(deviations);
  std::vector<bool> high(frames);
  for (std::size_t i = 0; i < frames; ++i) high[i] = smoothed[i] > limit;
  return high;
}

std::vector<double> mean_error_by_separation(const AlignmentErrors& errors,
                                             const std::vector<bool>& excluded) {
  if (!excluded.empty() && excluded.size() != errors.frames()) {
    throw std::invalid_argument("mean_error_by_separation: one flag per frame expected");
  }
  std::vector<double> means;
  for (const std::vector<float>& row : errors.by_separation) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!excluded.empty() && excluded[i]) continue;
      sum += row[i];
      ++count;
    }
    means.push_back(count > 0 ? sum / static_cast<double>(count) : (means.empty() ? 0 : means.back()));
  }
  return means;
}

}  // namespace vo
