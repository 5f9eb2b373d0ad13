#include "place/certainty/place_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace place {
namespace {

constexpr std::array<double, PlaceFilter::kRatios> kRatio{0.5, 0.71, 1, 1.41, 2};
constexpr std::ptrdiff_t kTriangle =
    4;  // as `search_path`: the best place is found from it and its neighbours

/// p(s) for s = first, first + 1, ... keyframes.
struct Kernel {
  std::size_t first = 0;
  std::vector<float> weight;
};

Kernel kernel_of(double step, double variance) {
  if (step == 0) return {0, {1.0F}};
  // Less than half a keyframe of deviation would not reach the next keyframe with a small step.
  constexpr double kLeast = 0.25, kDeviations = 3.2;
  const double deviation = std::sqrt(std::max(kLeast, variance));
  const double least = std::max(0.0, std::ceil(step - kDeviations * deviation));
  const double most = std::max(least, std::floor(step + kDeviations * deviation));
  Kernel kernel{static_cast<std::size_t>(least), {}};
  double sum = 0;
  for (double s = least; s <= most; ++s) {
    const double weight = std::exp(-(s - step) * (s - step) / (2 * deviation * deviation));
    kernel.weight.push_back(static_cast<float>(weight));
    sum += weight;
  }
  for (float& weight : kernel.weight) weight = static_cast<float>(static_cast<double>(weight) / sum);
  return kernel;
}

double sum_of(std::span<const float> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

double PlaceFilter::ratio(std::size_t i) {
  return kRatio.at(i);
}

PlaceFilter::PlaceFilter(std::vector<FilterStretch> stretches, const PlaceFilterOptions& options)
    : stretches_(std::move(stretches)), options_(options) {
  double paces = 0;
  for (const FilterStretch& stretch : stretches_) {
    if (stretch.begin != places_ || stretch.end <= stretch.begin || !(stretch.pace > 0))
      throw std::invalid_argument("PlaceFilter: stretches one after another, of a pace above 0, expected");
    places_ = stretch.end;
    paces += stretch.pace * static_cast<double>(stretch.end - stretch.begin);
  }
  if (places_ == 0) throw std::invalid_argument("PlaceFilter: at least one place expected");
  mean_pace_ = paces / static_cast<double>(places_);
  now_.on.assign(kRatios * places_, static_cast<float>(0.5 / static_cast<double>(kRatios * places_)));
  now_.off = 0.5;
}

double PlaceFilter::share(double moved, double rate) const {
  return 1 - std::exp(-rate * moved * mean_pace_);
}

/// A walker's ratio changes to a neighbouring one. The same forwards and backwards.
void PlaceFilter::change_speeds(Belief& belief, double moved) const {
  const auto change = static_cast<float>(share(moved, options_.change_speed) / 2);
  const std::vector<float> before = belief.on;
  for (std::size_t k = 0; k + 1 < kRatios; ++k) {
    const float* const low = before.data() + k * places_;
    const float* const high = low + places_;
    float* const to_low = belief.on.data() + k * places_;
    float* const to_high = to_low + places_;
    for (std::size_t r = 0; r < places_; ++r) {
      const float flow = change * (high[r] - low[r]);
      to_low[r] += flow;
      to_high[r] -= flow;
    }
  }
}

PlaceFilter::Belief PlaceFilter::moved_on(const Belief& before, double moved, double variance) const {
  Belief mixed = before, after;
  change_speeds(mixed, moved);
  const double leave = share(moved, options_.leave);
  const auto comes_back = static_cast<float>(leave * before.off / static_cast<double>(kRatios * places_));
  after.on.assign(before.on.size(), comes_back);
  for (std::size_t k = 0; k < kRatios; ++k) {
    for (const auto& [begin, end, pace] : stretches_) {
      const double scale = pace * kRatio[k];
      const auto [first, weight] = kernel_of(moved * scale, variance * scale * scale);
      for (std::size_t i = 0; i < weight.size(); ++i) {
        const std::size_t step = first + i;
        if (step >= end - begin) break;
        const float w = weight[i] * static_cast<float>(1 - leave);
        const float* const from = mixed.on.data() + k * places_ + begin;
        float* const to = after.on.data() + k * places_ + begin + step;
        for (std::size_t r = 0; r < end - begin - step; ++r) to[r] += w * from[r];
      }
    }
  }
  // What is not on the route is off it: who left, who stayed away, and who walked past an end.
  after.off = std::max(0.0, before.off + sum_of(before.on) - sum_of(after.on));
  return after;
}

/// The transpose: how probable what came later is, given the place before the move.
PlaceFilter::Belief PlaceFilter::moved_back(const Belief& after, double moved, double variance) const {
  const double leave = share(moved, options_.leave);
  Belief before;
  before.on.assign(after.on.size(), static_cast<float>(leave * after.off));
  for (std::size_t k = 0; k < kRatios; ++k) {
    for (const auto& [begin, end, pace] : stretches_) {
      const double scale = pace * kRatio[k];
      const auto [first, weight] = kernel_of(moved * scale, variance * scale * scale);
      for (std::size_t i = 0; i < weight.size(); ++i) {
        const std::size_t step = first + i, inside = end - begin - std::min(end - begin, step);
        const float w = weight[i] * static_cast<float>(1 - leave);
        float* const to = before.on.data() + k * places_ + begin;
        const float* const from = after.on.data() + k * places_ + begin + step;
        for (std::size_t r = 0; r < inside; ++r) to[r] += w * from[r];
        const float past_end = w * static_cast<float>(after.off);
        for (std::size_t r = inside; r < end - begin; ++r) to[r] += past_end;
      }
    }
  }
  change_speeds(before, moved);
  before.off = (1 - leave) * after.off + leave * sum_of(after.on) / static_cast<double>(after.on.size());
  return before;
}

void PlaceFilter::move(double moved, double variance) {
  if (!(moved >= 0) || !(variance >= 0))
    throw std::invalid_argument("PlaceFilter::move: no negative values expected");
  moved_ += moved;
  variance_ += variance;
}

void PlaceFilter::observe(std::span<const float> log_ratio) {
  if (log_ratio.size() != places_)
    throw std::invalid_argument("PlaceFilter::observe: one value for each place expected");
  now_ = moved_on(now_, moved_, variance_);
  std::vector<float> likelihood(places_);
  for (std::size_t r = 0; r < places_; ++r) likelihood[r] = std::exp(std::clamp(log_ratio[r], -30.0F, 30.0F));
  for (std::size_t k = 0; k < kRatios; ++k) {
    float* const on = now_.on.data() + k * places_;
    for (std::size_t r = 0; r < places_; ++r) on[r] *= likelihood[r];
  }
  const double total = sum_of(now_.on) + now_.off;
  const auto factor = static_cast<float>(1 / total);
  for (float& value : now_.on) value *= factor;
  now_.off /= total;
  if (options_.lag > 0) {
    steps_.push_back({moved_, variance_, std::move(likelihood), now_});
    if (steps_.size() > options_.lag + 1) steps_.pop_front();
  }
  moved_ = variance_ = 0;
}

PlaceEstimate PlaceFilter::estimate_of(const Belief& belief, std::size_t window) const {
  std::vector<float> at(places_, 0.0F);
  for (std::size_t k = 0; k < kRatios; ++k) {
    const float* const on = belief.on.data() + k * places_;
    for (std::size_t r = 0; r < places_; ++r) at[r] += on[r];
  }
  PlaceEstimate estimate;
  estimate.off_route = belief.off;
  // Places of one stretch only: neighbours across a gap are elsewhere.
  const FilterStretch* stretch = nullptr;
  float most = -1;
  for (const FilterStretch& one : stretches_) {
    const auto begin = static_cast<std::ptrdiff_t>(one.begin), end = static_cast<std::ptrdiff_t>(one.end);
    for (std::ptrdiff_t r = begin; r < end; ++r) {
      float sum = 0;
      for (std::ptrdiff_t d = 1 - kTriangle; d < kTriangle; ++d) {
        if (r + d < begin || r + d >= end) continue;
        sum += static_cast<float>(kTriangle - std::abs(d)) * at[static_cast<std::size_t>(r + d)];
      }
      if (sum <= most) continue;
      most = sum;
      estimate.place = static_cast<std::size_t>(r);
      stretch = &one;
    }
  }
  const std::size_t first = std::max(stretch->begin, estimate.place - std::min(estimate.place, window));
  const std::size_t past = std::min(stretch->end, estimate.place + window + 1);
  double sum = 0, mean = 0, square = 0, ratio = 0;
  for (std::size_t r = first; r < past; ++r) {
    const double x = static_cast<double>(r) - static_cast<double>(estimate.place);
    sum += static_cast<double>(at[r]);
    mean += static_cast<double>(at[r]) * x;
    square += static_cast<double>(at[r]) * x * x;
    for (std::size_t k = 0; k < kRatios; ++k)
      ratio += kRatio[k] * static_cast<double>(belief.on[k * places_ + r]);
  }
  estimate.probability = sum;
  estimate.mean = static_cast<double>(estimate.place);
  if (!(sum > 0)) return estimate;
  estimate.mean += mean / sum;
  estimate.sd = std::sqrt(std::max(0.0, square / sum - mean / sum * mean / sum));
  estimate.ratio = ratio / sum;
  return estimate;
}

PlaceEstimate PlaceFilter::estimate(std::size_t window) const {
  PlaceEstimate estimate = estimate_of(now_, window);
  if (moved_ == 0) return estimate;
  const auto stretch =
      std::ranges::find_if(stretches_, [&](const FilterStretch& one) { return estimate.place < one.end; });
  const double scale = stretch->pace * estimate.ratio, last = static_cast<double>(stretch->end - 1);
  estimate.mean = std::min(last, estimate.mean + moved_ * scale);
  estimate.sd = std::sqrt(estimate.sd * estimate.sd + variance_ * scale * scale);
  return estimate;
}

PlaceEstimate PlaceFilter::lagged(std::size_t window, std::size_t back) const {
  if (back >= steps_.size())
    throw std::invalid_argument("PlaceFilter::lagged: observations within the lag expected");
  const std::size_t at = steps_.size() - 1 - back;
  Belief later{std::vector<float>(now_.on.size(), 1.0F), 1};
  for (std::size_t i = steps_.size() - 1; i > at; --i) {
    const Step& step = steps_[i];
    for (std::size_t k = 0; k < kRatios; ++k) {
      float* const on = later.on.data() + k * places_;
      for (std::size_t r = 0; r < places_; ++r) on[r] *= step.likelihood[r];
    }
    later = moved_back(later, step.moved, step.variance);
    // Only proportions matter: kept within the numbers that there are.
    const double most = std::max(later.off, static_cast<double>(*std::ranges::max_element(later.on)));
    for (float& value : later.on) value = static_cast<float>(static_cast<double>(value) / most);
    later.off /= most;
  }
  Belief then = steps_[at].after;
  for (std::size_t i = 0; i < then.on.size(); ++i) then.on[i] *= later.on[i];
  then.off *= later.off;
  const double total = sum_of(then.on) + then.off;
  for (float& value : then.on) value = static_cast<float>(static_cast<double>(value) / total);
  then.off /= total;
  return estimate_of(then, window);
}

}  // namespace place
