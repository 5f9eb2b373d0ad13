#include "place/match/search_path.hpp"

#include "match/kernels/path_rows.hpp"
#include "match/path_model.hpp"
#include "place/match/search_method.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr std::ptrdiff_t kTriangle = 4;  // references, to either side, where its weight is 0

/// The posterior of one query, up to a factor, in chunks whose sums and maxima are kept, so that most of it
/// can be skipped.
class Posterior {
 public:
  static constexpr std::size_t kChunk = 64;

  void set(const PathModel::Row& forward, const PathModel::Row& backward) {
    values_.resize(forward.on.size());
    chunks_.clear();
    for (std::size_t begin = 0; begin < values_.size(); begin += kChunk) {
      chunks_.push_back(kernels_.multiply_chunk(forward.on.data() + begin, backward.on.data() + begin,
                                                std::min(kChunk, values_.size() - begin),
                                                values_.data() + begin));
    }
    off_ = forward.off * backward.off;
  }

  /// Where the triangle holds most; the first among equals.
  [[nodiscard]] std::size_t peak() const {
    float most = 0;
    for (const kernels::ChunkTotals& chunk : chunks_) most = std::max(most, chunk.most);
    // A triangle holds at most its weights' sum, kTriangle, times the highest value under it: only a value of
    // at least 1 / kTriangle of the best so far can lead to a better one.
    float best = most;
    std::size_t at = values_.size();
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      if (chunks_[c].most * kTriangle < best) continue;
      const std::size_t begin = c * kChunk - std::min<std::size_t>(c * kChunk, kTriangle - 1);
      const std::size_t end = std::min(values_.size(), (c + 1) * kChunk + kTriangle - 1);
      for (std::size_t r = begin; r < end; ++r) {
        const float value = triangle(r);
        if (value > best || (value == best && (at == values_.size() || r < at))) {
          best = value;
          at = r;
        }
      }
    }
    return at;
  }

  /// log(inside / outside) of the window about a reference.
  [[nodiscard]] double log_odds(std::size_t at, std::size_t window) const {
    const std::size_t begin = at - std::min(at, window), end = std::min(values_.size(), at + window + 1);
    double inside = 0, outside = off_;
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      const std::size_t first = c * kChunk, past = std::min(values_.size(), first + kChunk);
      if (past <= begin || first >= end) {
        outside += chunks_[c].sum;
        continue;
      }
      for (std::size_t r = first; r < past; ++r)
        (r >= begin && r < end ? inside : outside) += static_cast<double>(values_[r]);
    }
    return std::log(inside / outside);
  }

 private:
  [[nodiscard]] float triangle(std::size_t at) const {
    const auto centre = static_cast<std::ptrdiff_t>(at), count = static_cast<std::ptrdiff_t>(values_.size());
    float sum = 0;
    for (std::ptrdiff_t d = 1 - kTriangle; d < kTriangle; ++d) {
      if (centre + d < 0 || centre + d >= count) continue;
      sum += static_cast<float>(kTriangle - std::abs(d)) / static_cast<float>(kTriangle) *
             values_[static_cast<std::size_t>(centre + d)];
    }
    return sum;
  }

  const kernels::PathKernels& kernels_ = kernels::path_kernels();
  std::vector<float> values_;
  std::vector<kernels::ChunkTotals> chunks_;
  double off_ = 0;
};

/// Matches of the queries of one stretch, at the places `given` or else where they are most probable. The
/// forward pass is made twice, the second time from kept rows, last one first, so that only 2 sqrt(queries)
/// rows need to be kept.
void search_stretch(const CostMatrix& enhanced, const SearchOptions& options, const PathModel& model,
                    Stretch queries, std::span<const SequenceMatch> given,
                    std::vector<SequenceMatch>& matches) {
  const std::size_t count = queries.end - queries.begin;
  const auto block = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  std::vector<float> row_likelihoods(enhanced.references);
  const auto likelihoods_at = [&](std::size_t i, std::vector<float>& out) {
    out.resize(enhanced.references);
    model.likelihoods(enhanced.row(queries.begin + i), out);
  };
  const auto step = [&](std::size_t i, const PathModel::Row& before, const std::vector<float>& likelihoods,
                        PathModel::Row& row) {
    if (i == 0) {
      model.begin(likelihoods, row);
    } else {
      model.forward(queries.begin + i, before, likelihoods, row);
    }
  };

  std::vector<PathModel::Row> kept;  // the row before each block
  PathModel::Row row, next;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % block == 0) kept.push_back(row);
    if ((i / block + 1) * block >= count) break;  // the last block is made below
    likelihoods_at(i, row_likelihoods);
    step(i, row, row_likelihoods, next);
    std::swap(row, next);
  }

  PathModel::Row backward{.on = std::vector<float>(enhanced.references, 1.0F), .off = 1, .scale = 1};
  PathModel::Row backward_next;
  std::vector<PathModel::Row> rows(block);
  std::vector<std::vector<float>> likelihoods(block);
  std::vector<float> work;
  Posterior posterior;
  for (std::size_t b = kept.size(); b-- > 0;) {
    const std::size_t begin = b * block, end = std::min(count, begin + block);
    for (std::size_t i = begin; i < end; ++i) {
      likelihoods_at(i, likelihoods[i - begin]);
      step(i, i == begin ? kept[b] : rows[i - begin - 1], likelihoods[i - begin], rows[i - begin]);
    }
    for (std::size_t i = end; i-- > begin;) {
      posterior.set(rows[i - begin], backward);
      const std::size_t query = queries.begin + i;
      const std::optional<std::size_t> at =
          given.empty() ? std::optional(posterior.peak()) : given[query].reference;
      if (at)
        matches[query] = {.reference = at,
                          .cost = enhanced.at(query, *at),
                          .score = static_cast<float>(posterior.log_odds(
                              *at, static_cast<std::size_t>(options.sequence.uniqueness_window))),
                          .terms = options.sequence.length};
      if (i == 0) break;
      model.backward(query, backward, likelihoods[i - begin], backward_next, work);
      std::swap(backward, backward_next);
    }
  }
}

}  // namespace

bool PathSearchOptions::is_valid(std::string* reason) const {
  const auto invalid = [&](std::string text) {
    if (reason != nullptr) *reason = std::move(text);
    return false;
  };
  constexpr double kLongest = 1000;  // references: a gap, not a step
  for (const double step : steps) {
    if (!(step >= 0 && step <= kLongest))
      return invalid(fmt::format("a step is {} references; 0 <= step <= {} expected", step, kLongest));
  }
  return true;
}

namespace {

std::vector<SequenceMatch> matches_on_path(const CostMatrix& enhanced, std::span<const SequenceMatch> given,
                                           const SearchOptions& options) {
  std::string reason;
  if (!options.path.is_valid(&reason) || !options.sequence.is_valid(&reason))
    throw std::invalid_argument("search_path: " + reason);
  if (!options.path.steps.empty() && options.path.steps.size() != enhanced.queries)
    throw std::invalid_argument("search_path: one step for each query expected");
  std::vector<SequenceMatch> matches(enhanced.queries);
  if (enhanced.values.empty()) return matches;
  const PathModel model(options.path, options.sequence,
                        stretches_between(options.gaps.reference, enhanced.references), enhanced.references);
  const std::vector<Stretch> stretches = stretches_between(options.gaps.query, enhanced.queries);
  vo::parallel_for(stretches.size(), [&](std::size_t i) {
    search_stretch(enhanced, options, model, stretches[i], given, matches);
  });
  return matches;
}

}  // namespace

SearchResult search_path(const CostMatrix& enhanced, const SearchOptions& options) {
  return {.matches = matches_on_path(enhanced, {}, options)};
}

std::vector<SequenceMatch> path_scores(const CostMatrix& enhanced, std::span<const SequenceMatch> matches,
                                       const SearchOptions& options) {
  const auto is_inside = [&](const SequenceMatch& m) {
    return !m.reference || *m.reference < enhanced.references;
  };
  if (matches.size() != enhanced.queries || !std::ranges::all_of(matches, is_inside))
    throw std::invalid_argument("path_scores: one match on the reference for each query expected");
  return matches_on_path(enhanced, matches, options);
}

}  // namespace place
