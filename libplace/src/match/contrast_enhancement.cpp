#include "place/match/contrast_enhancement.hpp"

#include "match/messages.hpp"
#include "match/moments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

/// Eight sums of every eighth value, which compilers vectorise, then their total.
CostMoments cost_moments_of(std::span<const float> values) {
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

/// A row that begins at a multiple of kAlign. Running sums restart at every such multiple, so that a value
/// does not depend on where the row begins.
void enhance_locally(std::span<float> row, std::size_t half) {
  const std::vector<float> raw(row.begin(), row.end());
  CostMoments window;
  std::size_t first = 0, last = 0;  // the window is [first, last)
  for (std::size_t r = 0; r < raw.size(); ++r) {
    if (r % ContrastEnhancer::kAlign == 0) {
      window = {};
      first = last = r - std::min(r, half);
    }
    while (last < std::min(raw.size(), r + half + 1)) window.add(raw[last++]);
    while (first + half < r) window.remove(raw[first++]);
    const auto count = static_cast<double>(last - first);
    row[r] = static_cast<float>((raw[r] - window.sum / count) * window.inverse_deviation(count, 1));
  }
}

/// 1 / sqrt(share * variance + 1 - share) from 1 / deviation, 0 where there is none.
double drawn_to_one(double inverse_deviation, double share) {
  if (share == 1) return inverse_deviation;
  const double variance = inverse_deviation > 0 ? 1 / (inverse_deviation * inverse_deviation) : 0;
  return 1 / std::sqrt(share * variance + 1 - share);
}

float standard_score(float value, double mean, double inverse_deviation) {
  return static_cast<float>((value - mean) * inverse_deviation);
}

}  // namespace

/// Sums of every query's costs, block by block.
struct ContrastEnhancer::Survey {
  struct Row {
    std::vector<CostMoments> of_query;

    Row& operator+=(const Row& more) {
      for (std::size_t q = 0; q < of_query.size(); ++q) of_query[q].add(more.of_query[q]);
      return *this;
    }
  };
  TreeSum<Row> sum;
};

ContrastEnhancer::ContrastEnhancer(std::size_t queries, std::size_t references,
                                   const ContrastEnhancementOptions& options)
    : ContrastEnhancer(queries, references, options, {0, references}, 0) {
  alone_ = true;
}

ContrastEnhancer::ContrastEnhancer(std::size_t queries, std::size_t references,
                                   const ContrastEnhancementOptions& options, const Shard& own,
                                   std::size_t first)
    : queries_(queries),
      references_(references),
      options_(options),
      begin_(own.begin - first),
      end_(own.end - first),
      surveyed_(begin_) {
  if (options.window < 2) throw std::invalid_argument("enhance_contrast: window must be >= 2");
  if (!(options.prior_queries >= 0))
    throw std::invalid_argument("enhance_contrast: prior_queries must be >= 0");
  if (options.method != Enhancement::kStandardise) return;
  survey_ = std::make_shared<Survey>(Survey{TreeSum<Survey::Row>(own.begin / kPart)});
}

std::size_t ContrastEnhancer::margin() const {
  if (options_.method != Enhancement::kLocal) return 0;
  return (static_cast<std::size_t>(options_.window / 2) + kAlign - 1) / kAlign * kAlign;
}

void ContrastEnhancer::survey(const ConstCosts& costs, std::size_t count) {
  const std::size_t first = surveyed_, past = first + count;
  if (past > end_ || (past < end_ && count % kPart != 0) || costs.queries != queries_ ||
      costs.first_reference + std::min(first, margin()) != first ||
      costs.first_reference + costs.references != std::min(end_, past + margin())) {
    throw std::invalid_argument(
        "ContrastEnhancer: parts of the reference by all queries, in order, expected");
  }
  surveyed_ = past;
  const std::size_t before = first - costs.first_reference;
  if (options_.method == Enhancement::kStandardise) {
    constexpr std::size_t kTogether = 64;  // blocks whose sums are kept at a time
    for (std::size_t from = 0; from < count; from += kTogether * kPart) {
      const std::size_t blocks = std::min(kTogether, (count - from + kPart - 1) / kPart);
      std::vector<Survey::Row> rows(blocks, Survey::Row{std::vector<CostMoments>(queries_)});
      vo::parallel_for(queries_, [&](std::size_t q) {
        for (std::size_t i = 0; i < blocks; ++i) {
          const std::size_t r = from + i * kPart;
          rows[i].of_query[q] = cost_moments_of(costs.row(q).subspan(before + r, std::min(kPart, count - r)));
        }
      });
      for (Survey::Row& row : rows) survey_->sum.add(std::move(row));
    }
    if (alone_ && past == references_) standardise_by(*survey_);
    return;
  }
  ready_ = past == end_;
  std::vector<CostRange> ranges(queries_);
  vo::parallel_for(queries_, [&](std::size_t q) {
    if (options_.method == Enhancement::kNone) {
      ranges[q] = range_of(costs.row(q).subspan(before, count));
    } else {
      std::vector<float> enhanced(costs.row(q).begin(), costs.row(q).end());
      enhance_locally(enhanced, static_cast<std::size_t>(options_.window / 2));
      ranges[q] = range_of(std::span(enhanced).subspan(before, count));
    }
  });
  for (const CostRange& range : ranges) {
    sum_ += range.centre * static_cast<double>(count);
    least_ = std::min(least_, range.centre - range.largest);
    most_ = std::max(most_, range.centre + range.largest);
  }
}

void ContrastEnhancer::standardise_by(const Survey& survey) {
  const Survey::Row total = survey.sum.total();
  for (std::size_t q = 0; q < total.of_query.size(); ++q) {
    mean_.push_back(total.of_query[q].sum / static_cast<double>(references_));
    inverse_deviation_.push_back(total.of_query[q].inverse_deviation(static_cast<double>(references_), 0));
  }
  survey_.reset();
  ready_ = true;
}

void ContrastEnhancer::share(Team& team) {
  if (options_.method != Enhancement::kStandardise) ready_ = true;
  if (ready_) return;
  if (surveyed_ != end_) throw std::invalid_argument("ContrastEnhancer: a survey of the shard expected");
  MessageWriter message;
  message.put(survey_->sum.nodes().size());
  for (const auto& node : survey_->sum.nodes()) {
    message.put(node.index);
    message.put(node.level);
    message.put_all(node.sum.of_query);
  }
  Survey whole;
  for (const Team::Message& received : team.exchange(message.bytes())) {
    MessageReader reader(received);
    for (auto left = reader.get<std::size_t>(); left > 0; --left) {
      const auto index = reader.get<std::uint64_t>(), level = reader.get<std::uint64_t>();
      whole.sum.append({index, level, {reader.get_all<CostMoments>()}});
    }
  }
  standardise_by(whole);
}

void ContrastEnhancer::enhance(const Costs& costs) const {
  if (costs.queries != queries_ || costs.first_reference % kAlign != 0 ||
      !(ready_ || queries_ == 0 || references_ == 0)) {
    throw std::invalid_argument("ContrastEnhancer: a survey of all, and an aligned part, expected");
  }
  if (options_.method == Enhancement::kNone) return;
  if (options_.method == Enhancement::kLocal) {
    vo::parallel_for(queries_, [&](std::size_t q) {
      enhance_locally(costs.row(q), static_cast<std::size_t>(options_.window / 2));
    });
    return;
  }
  constexpr std::size_t kStretch = 128;  // references whose costs with a few thousand queries fit a cache
  vo::parallel_for((costs.references + kStretch - 1) / kStretch, [&](std::size_t i) {
    const std::size_t begin = i * kStretch, count = std::min(kStretch, costs.references - begin);
    std::array<double, kStretch> mean{}, inverse{};  // first the sums and the sums of squares
    for (std::size_t q = 0; q < queries_; ++q) {
      float* row = costs.row(q).data() + begin;
      for (std::size_t r = 0; r < count; ++r) {
        row[r] = standard_score(row[r], mean_[q], inverse_deviation_[q]);
        const double score = row[r];
        mean[r] += score;
        inverse[r] += score * score;
      }
    }
    const auto queries = static_cast<double>(queries_);
    const double share = queries / (queries + options_.prior_queries);
    for (std::size_t r = 0; r < count; ++r) {
      const CostMoments moments{mean[r], inverse[r]};
      mean[r] = share * moments.sum / queries;
      inverse[r] = drawn_to_one(moments.inverse_deviation(queries, 0), share);
    }
    for (std::size_t q = 0; q < queries_; ++q) {
      float* row = costs.row(q).data() + begin;
      for (std::size_t r = 0; r < count; ++r) row[r] = standard_score(row[r], mean[r], inverse[r]);
    }
  });
}

CostRange ContrastEnhancer::range() const {
  if (queries_ == 0 || references_ == 0) return {};
  if (options_.method == Enhancement::kStandardise) {
    // None of n values can be further than sqrt(n - 1) deviations from their mean; one more for rounding.
    const auto queries = static_cast<double>(queries_), references = static_cast<double>(references_);
    const double share = queries / (queries + options_.prior_queries);
    // With a prior, |x - m| / sqrt(share * variance) and (1 - share) |m| / sqrt(1 - share), where the mean m
    // is no further from 0 than a value of n references can be.
    return {.centre = 0, .largest = std::sqrt(queries / share) + std::sqrt((1 - share) * references)};
  }
  const double centre = sum_ / (static_cast<double>(queries_) * static_cast<double>(references_));
  return {.centre = centre, .largest = std::max(most_ - centre, centre - least_)};
}

void enhance_contrast(CostMatrix& costs, const ContrastEnhancementOptions& options) {
  ContrastEnhancer enhancer(costs.queries, costs.references, options);
  if (costs.values.empty()) return;
  enhancer.survey(block_of(costs), costs.references);
  enhancer.enhance(block_of(costs));
}

}  // namespace place
