#include "place/route/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace place {

namespace {

/// Appends the keyframes of frames [begin, end).
void resample_part(std::span<const double> displacement, std::size_t begin, std::size_t end, double unit,
                   std::vector<std::size_t>& keyframes) {
  if (begin >= end) return;
  keyframes.push_back(begin);
  double travelled = 0;
  double next = unit;
  for (std::size_t i = begin + 1; i < end; ++i) {
    const double before = travelled;
    travelled += displacement[i];
    if (travelled < next) continue;
    // The multiples between the two frames: the first may be nearer to the frame before, the last to this
    // one, and those in between have no frame.
    const double last = std::max(next, std::floor(travelled / unit) * unit);
    if (next - before < travelled - next && i - 1 > keyframes.back()) keyframes.push_back(i - 1);
    if (travelled - last <= last - before) keyframes.push_back(i);
    next = last + unit;
  }
}

}  // namespace

double sampling_unit(std::span<const double> displacement, std::span<const double> time_s, double n) {
  constexpr double kFrame_s = 0.04;
  if (displacement.size() < 2) throw std::invalid_argument("sampling_unit: at least two frames expected");
  if (time_s.size() != displacement.size())
    throw std::invalid_argument("sampling_unit: one time per frame expected");
  if (!(n > 0)) throw std::invalid_argument("sampling_unit: n must be positive");
  double moving_s = 0, distance = 0;
  for (std::size_t i = 1; i < displacement.size(); ++i) {
    if (!(displacement[i] > 0)) continue;
    moving_s += time_s[i] - time_s[i - 1];
    distance += displacement[i];
  }
  if (!(moving_s > 0)) return 0;
  const double mean = distance / moving_s;
  double variance = 0;
  for (std::size_t i = 1; i < displacement.size(); ++i) {
    if (!(displacement[i] > 0)) continue;
    const double frame_s = time_s[i] - time_s[i - 1];
    const double off = displacement[i] / frame_s - mean;
    variance += off * off * frame_s / moving_s;
  }
  return n * kFrame_s * (mean + 2 * std::sqrt(variance));
}

std::vector<std::size_t> resample(std::span<const double> displacement, double unit,
                                  std::span<const std::size_t> begins) {
  if (!(unit > 0)) throw std::invalid_argument("resample: unit must be positive");
  std::vector<std::size_t> keyframes;
  std::size_t from = 0;
  for (const std::size_t begin : begins) {
    if (begin < from || begin >= displacement.size())
      throw std::invalid_argument("resample: increasing frames of the walk expected");
    resample_part(displacement, from, begin, unit, keyframes);
    from = begin;
  }
  resample_part(displacement, from, displacement.size(), unit, keyframes);
  return keyframes;
}

std::vector<std::size_t> every_kth(std::size_t frames, std::size_t k) {
  if (k == 0) throw std::invalid_argument("every_kth: k must be >= 1");
  std::vector<std::size_t> keyframes;
  for (std::size_t i = 0; i < frames; i += k) keyframes.push_back(i);
  return keyframes;
}

}  // namespace place
