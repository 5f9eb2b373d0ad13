#include "match/path_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace place {
PathModel::PathModel(const PathSearchOptions& options, const SequenceSearchOptions& sequence,
                     std::vector<Stretch> references, std::size_t count)
    : references_(std::move(references)), count_(count) {
  constexpr double kMostOften = 0.1;  // for sequences of one keyframe
  leave_ = kMostOften / sequence.length;
  const double range = sequence.search_range_rad, quarter = std::numbers::pi / 4;
  const double low = sequence.v_min.value_or(std::tan(quarter - range));
  const double high = sequence.v_max.value_or(std::tan(quarter + range));
  constexpr double kSampling = 0.98, kWidest = 5;
  const double middle = sequence.v_min ? (low + high) / 2 : 1;
  const double unit_deviation = std::hypot(kSampling, std::min(kWidest, (high - low) / 2));
  const std::vector<double> even{1};
  for (const double relative : options.steps.empty() ? even : options.steps) {
    // Steps a little past three deviations are left out, so that a step of 1 has 0 .. 4.
    constexpr double kDeviations = 3.2;
    const double step = relative * middle;
    const double deviation = unit_deviation * std::sqrt(std::max(1.0, step));
    const double least = std::max(0.0, std::ceil(step - kDeviations * deviation));
    const double most = std::max(least, std::floor(step + kDeviations * deviation));
    std::vector<double> weights;
    double sum = 0;
    for (double s = least; s <= most; ++s) {
      weights.push_back(std::exp(-(s - step) * (s - step) / (2 * deviation * deviation)));
      sum += weights.back();
    }
    Steps& steps = steps_.emplace_back();
    steps.first = static_cast<std::size_t>(least);
    for (const double weight : weights) steps.probability.push_back(static_cast<float>(weight / sum));
  }
}

void PathModel::likelihoods(std::span<const float> costs, std::span<float> out) const {
  constexpr float kSteepness = 0.5F, kEven = -1, kFurthest = 6, kLog2E = 1.44269504F;
  kernels_.likelihoods(costs.data(), costs.size(), kEven, kSteepness * kLog2E, kFurthest, out.data());
}

void PathModel::begin(std::span<const float> likelihoods, Row& row) const {
  row.on.assign(count_, static_cast<float>(0.5 / static_cast<double>(count_)));
  row.off = 0.5;
  row.scale = 1 / (row.off + kernels_.multiply(row.on.data(), likelihoods.data(), count_, row.on.data()));
}

void PathModel::forward(std::size_t query, const Row& before, std::span<const float> likelihoods,
                        Row& row) const {
  const Steps& steps = steps_to(query);
  const std::size_t widest = steps.first + steps.probability.size() - 1;
  const double off = before.off * before.scale;
  const double comes_back = leave_ * off / static_cast<double>(count_);
  // A reference takes from those before it, so the taps are reversed.
  std::vector<float> taps(steps.probability.size());
  for (std::size_t k = 0; k < taps.size(); ++k)
    taps[k] = static_cast<float>((1 - leave_) * before.scale) * steps.probability[taps.size() - 1 - k];
  row.on.resize(count_);
  double past_end = 0;
  for (const auto& [begin, end] : references_) {
    const float* from = before.on.data();
    for (std::size_t r = begin; r < std::min(end, begin + widest); ++r) {
      float sum = static_cast<float>(comes_back);
      for (std::size_t k = 0; k < taps.size(); ++k) {
        if (r + k >= begin + widest) sum += taps[k] * from[r + k - widest];
      }
      row.on[r] = sum;
    }
    if (end - begin > widest)
      kernels_.convolve(from + begin, end - begin - widest, taps.data(), taps.size(),
                        static_cast<float>(comes_back), row.on.data() + begin + widest);
    for (std::size_t r = end - std::min(end - begin, widest); r < end; ++r) {
      for (std::size_t k = 0; k < steps.probability.size(); ++k) {
        if (r + steps.first + k >= end)
          past_end += static_cast<double>(steps.probability[k]) * static_cast<double>(from[r]);
      }
    }
  }
  past_end *= before.scale;
  const double on = 1 - off - past_end;  // rows of this pass add up to 1
  row.off = off * (1 - leave_) + leave_ * on + past_end;
  row.scale = 1 / (row.off + kernels_.multiply(row.on.data(), likelihoods.data(), count_, row.on.data()));
}

void PathModel::backward(std::size_t query, const Row& after, std::span<const float> likelihoods, Row& row,
                         std::vector<float>& work) const {
  const Steps& steps = steps_to(query);
  const std::size_t widest = steps.first + steps.probability.size() - 1;
  work.resize(count_);
  const double mean = kernels_.multiply(after.on.data(), likelihoods.data(), count_, work.data()) /
                      static_cast<double>(count_) * after.scale;
  const double off = after.off * after.scale;
  std::vector<float> taps(steps.probability.size());
  for (std::size_t k = 0; k < taps.size(); ++k)
    taps[k] = static_cast<float>((1 - leave_) * after.scale) * steps.probability[k];
  const auto leaves = static_cast<float>(leave_ * off);
  row.on.resize(count_);
  for (const auto& [begin, end] : references_) {
    const std::size_t whole = end - begin > widest ? end - begin - widest : 0;
    kernels_.convolve(work.data() + begin + steps.first, whole, taps.data(), taps.size(), leaves,
                      row.on.data() + begin);
    for (std::size_t r = begin + whole; r < end; ++r) {
      float sum = leaves;
      for (std::size_t k = 0; k < taps.size(); ++k) {
        const std::size_t to = r + steps.first + k;
        // Past the end is certainly off the route, not with probability leave_.
        sum += to < end ? taps[k] * work[to] : static_cast<float>((1 - leave_) * off) * steps.probability[k];
      }
      row.on[r] = sum;
    }
  }
  row.off = (1 - leave_) * off + leave_ * mean;
  row.scale = 1 / std::max(row.off, mean);
}

}  // namespace place
