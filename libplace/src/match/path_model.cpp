#include "match/path_model.hpp"

#include "match/messages.hpp"
#include "place/match/search_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace place {
PathModel::PathModel(const PathSearchOptions& options, const SequenceSearchOptions& sequence,
                     std::vector<Stretch> references, std::size_t count, Shard own, std::size_t beside,
                     Team& team)
    : references_(std::move(references)), count_(count), own_(own), beside_(beside), team_(team) {
  constexpr double kMostOften = 0.1;  // for sequences of one keyframe
  leave_ = kMostOften / sequence.length;
  const double range = std::min(sequence.search_range_rad, kSteepestRangeRad), quarter = std::numbers::pi / 4;
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
    halo_ = std::max(halo_, beside + steps.first + steps.probability.size() - 1);
  }
  first_ = own.size() > 0 ? own.begin - std::min(own.begin, halo_) : own.begin;
  last_ = own.size() > 0 ? std::min(count, own.end + halo_) : own.end;
}

void PathModel::likelihoods(std::span<const float> costs, std::span<float> out) const {
  constexpr float kSteepness = 0.5F, kEven = -1, kFurthest = 6, kLog2E = 1.44269504F;
  kernels_.likelihoods(costs.data(), costs.size(), kEven, kSteepness * kLog2E, kFurthest, out.data());
}

PathModel::Sums PathModel::multiply(const std::vector<float>& row, std::span<const float> likelihoods,
                                    std::vector<float>& out, std::span<const double> ends) const {
  TreeSum<double> sum(own_.begin / kShardBlock);
  for (std::size_t i = 0; i < own_.size(); i += kShardBlock) {
    const std::size_t at = own_.begin - first_ + i;
    sum.add(kernels_.multiply(row.data() + at, likelihoods.data() + i, std::min(kShardBlock, own_.size() - i),
                              out.data() + at));
  }
  return share(out, sum, ends);
}

PathModel::Sums PathModel::share(std::vector<float>& row, const TreeSum<double>& sum,
                                 std::span<const double> ends) const {
  Sums sums;
  if (team_.size() == 1) {
    for (const double end : ends) sums.ends += end;
    sums.row = sum.total();
    return sums;
  }
  // Everyone says its sums and the values at either end of its shard.
  const std::span<const float> own = std::span(row).subspan(own_.begin - first_, own_.size());
  const std::size_t reach = std::min(halo_, own.size());
  MessageWriter message;
  message.put_all(std::span(sum.nodes()));
  message.put_all(ends);
  message.put_all(own.first(reach));
  message.put_all(own.last(reach));
  TreeSum<double> whole;
  std::vector<float> before, after;
  const std::vector<Team::Message> messages = team_.exchange(message.bytes());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    MessageReader received(messages[i]);
    for (const TreeNode<double>& node : received.get_all<TreeNode<double>>()) whole.append(node);
    for (const double end : received.get_all<double>()) sums.ends += end;
    const std::vector<float> head = received.get_all<float>(), tail = received.get_all<float>();
    if (i < team_.rank()) before.insert(before.end(), tail.begin(), tail.end());
    if (i > team_.rank()) after.insert(after.end(), head.begin(), head.end());
  }
  const std::size_t left = own_.begin - first_, right = last_ - own_.end;
  std::copy(before.end() - static_cast<std::ptrdiff_t>(left), before.end(), row.begin());
  std::copy_n(after.begin(), right, row.end() - static_cast<std::ptrdiff_t>(right));
  sums.row = whole.total();
  return sums;
}

void PathModel::begin(std::span<const float> likelihoods, Row& row) const {
  row.on.assign(width(), static_cast<float>(0.5 / static_cast<double>(count_)));
  row.off = 0.5;
  row.scale = 1 / (row.off + multiply(row.on, likelihoods, row.on, {}).row);
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
  row.on.resize(width());
  std::vector<double> past_ends;
  const float* const from = before.on.data();
  for (const auto& [begin, end] : references_) {
    const std::size_t low = std::max(begin, own_.begin), high = std::min(end, own_.end);
    if (low >= high) continue;
    for (std::size_t r = low; r < std::min(high, begin + widest); ++r) {
      float sum = static_cast<float>(comes_back);
      for (std::size_t k = 0; k < taps.size(); ++k) {
        if (r + k >= begin + widest) sum += taps[k] * from[r + k - widest - first_];
      }
      row.on[r - first_] = sum;
    }
    const std::size_t whole = std::max(low, begin + widest);
    if (whole < high)
      kernels_.convolve(from + (whole - widest - first_), high - whole, taps.data(), taps.size(),
                        static_cast<float>(comes_back), row.on.data() + (whole - first_));
    if (high < end) continue;
    double past_end = 0;
    for (std::size_t r = end - std::min(end - begin, widest); r < end; ++r) {
      for (std::size_t k = 0; k < steps.probability.size(); ++k) {
        if (r + steps.first + k >= end)
          past_end += static_cast<double>(steps.probability[k]) * static_cast<double>(from[r - first_]);
      }
    }
    past_ends.push_back(past_end);
  }
  const Sums sums = multiply(row.on, likelihoods, row.on, past_ends);
  const double past_end = sums.ends * before.scale;
  const double on = 1 - off - past_end;  // rows of this pass add up to 1
  row.off = off * (1 - leave_) + leave_ * on + past_end;
  row.scale = 1 / (row.off + sums.row);
}

void PathModel::backward(std::size_t query, const Row& after, std::span<const float> likelihoods, Row& row,
                         std::vector<float>& work) const {
  const Steps& steps = steps_to(query);
  const std::size_t widest = steps.first + steps.probability.size() - 1;
  work.resize(width());
  const double mean =
      multiply(after.on, likelihoods, work, {}).row / static_cast<double>(count_) * after.scale;
  const double off = after.off * after.scale;
  std::vector<float> taps(steps.probability.size());
  for (std::size_t k = 0; k < taps.size(); ++k)
    taps[k] = static_cast<float>((1 - leave_) * after.scale) * steps.probability[k];
  const auto leaves = static_cast<float>(leave_ * off);
  row.on.resize(width());
  const std::size_t wanted_low = std::max(first_, own_.begin - std::min(own_.begin, beside_)),
                    wanted_high = std::min(last_, own_.end + beside_);
  for (const auto& [begin, end] : references_) {
    const std::size_t low = std::max(begin, wanted_low), high = std::min(end, wanted_high);
    if (low >= high) continue;
    const std::size_t whole = std::clamp(end - std::min(end - begin, widest), low, high);
    if (whole > low)
      kernels_.convolve(work.data() + (low + steps.first - first_), whole - low, taps.data(), taps.size(),
                        leaves, row.on.data() + (low - first_));
    for (std::size_t r = whole; r < high; ++r) {
      float sum = leaves;
      for (std::size_t k = 0; k < taps.size(); ++k) {
        const std::size_t to = r + steps.first + k;
        // Past the end is certainly off the route, not with probability leave_.
        sum += to < end ? taps[k] * work[to - first_]
                        : static_cast<float>((1 - leave_) * off) * steps.probability[k];
      }
      row.on[r - first_] = sum;
    }
  }
  row.off = (1 - leave_) * off + leave_ * mean;
  row.scale = 1 / std::max(row.off, mean);
}

}  // namespace place
