#include "place/match/search_path.hpp"

#include "kernels/path_rows.hpp"
#include "match/messages.hpp"
#include "match/part_searches.hpp"
#include "match/path_model.hpp"
#include "place/match/search_method.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include <vo/base/parallel.hpp>
#include <vo/base/stopping.hpp>

namespace place {
namespace {

constexpr std::ptrdiff_t kTriangle = 4;  // references, to either side, where its weight is 0

/// Where a triangle over the posterior holds most.
struct Peak {
  float value = -1;
  float cost = 0;
  std::uint64_t reference = 0;
};

/// The posterior's mass inside a window and outside it.
struct Odds {
  double inside = 0, outside = 0;

  Odds& operator+=(const Odds& more) {
    inside += more.inside;
    outside += more.outside;
    return *this;
  }
};

/// The posterior of one query, up to a factor, in chunks whose sums and maxima are kept, so that most of it
/// can be skipped. Values are those of a model's rows; chunks are of its shard alone.
class Posterior {
 public:
  static constexpr std::size_t kChunk = 64;
  static_assert(kShardBlock % kChunk == 0);

  Posterior(const PathModel& model, Shard own) : first_(model.first()), own_(own), values_(model.width()) {}

  void set(const PathModel::Row& forward, const PathModel::Row& backward) {
    const std::size_t begin = own_.begin - first_, end = own_.end - first_;
    chunks_.clear();
    for (std::size_t at = begin; at < end; at += kChunk) {
      chunks_.push_back(kernels_.multiply_chunk(forward.on.data() + at, backward.on.data() + at,
                                                std::min(kChunk, end - at), values_.data() + at));
    }
    const auto beside = static_cast<std::size_t>(kTriangle - 1);
    for (std::size_t at = begin - std::min(begin, beside); at < begin; ++at)
      values_[at] = forward.on[at] * backward.on[at];
    for (std::size_t at = end; at < std::min(values_.size(), end + beside); ++at)
      values_[at] = forward.on[at] * backward.on[at];
    off_ = forward.off * backward.off;
  }

  /// The first of the shard's references where the triangle holds most.
  [[nodiscard]] Peak peak() const {
    Peak best;
    if (own_.size() == 0) return best;
    const auto beside = static_cast<std::size_t>(kTriangle - 1);
    const auto look_at = [&](std::size_t begin, std::size_t end) {
      for (std::size_t at = begin; at < end; ++at) {
        const float value = triangle(at);
        if (value > best.value || (value == best.value && at + first_ < best.reference))
          best = {value, 0, at + first_};
      }
    };
    const std::size_t begin = own_.begin - first_, end = own_.end - first_;
    for (const kernels::ChunkTotals& chunk : chunks_) best.value = std::max(best.value, chunk.most);
    best.reference = own_.end;
    // A triangle holds at most its weights' sum, kTriangle, times the highest value under it: only a value of
    // at least 1 / kTriangle of the best so far can lead to a better one; a little more for rounding.
    constexpr float kMost = kTriangle + 0.001F;
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      if (chunks_[c].most * kMost < best.value) continue;
      const std::size_t at = begin + c * kChunk;
      look_at(std::max(begin, at - std::min(at, beside)), std::min(end, at + kChunk + beside));
    }
    // The neighbours' values may be high too.
    if (begin > 0) look_at(begin, std::min(end, begin + beside));
    if (end < values_.size()) look_at(std::max(begin, end - std::min(end, beside)), end);
    return best;
  }

  /// The mass in and out of the window about a reference, on the shard and, with the sum over all, off the
  /// route.
  [[nodiscard]] TreeSum<Odds> odds(std::size_t at, std::size_t window) const {
    const std::size_t begin = at - std::min(at, window), end = at + window + 1;
    TreeSum<Odds> sum(own_.begin / kShardBlock);
    constexpr std::size_t kTogether = kShardBlock / kChunk;
    for (std::size_t c = 0; c < chunks_.size();) {
      Odds block;
      for (const std::size_t past_block = std::min(chunks_.size(), c + kTogether); c < past_block; ++c) {
        const std::size_t first = own_.begin + c * kChunk, past = std::min(own_.end, first + kChunk);
        if (past <= begin || first >= end) {
          block.outside += chunks_[c].sum;
          continue;
        }
        for (std::size_t r = first; r < past; ++r)
          (r >= begin && r < end ? block.inside : block.outside) += static_cast<double>(values_[r - first_]);
      }
      sum.add(block);
    }
    return sum;
  }

  [[nodiscard]] double off() const { return off_; }

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
  std::size_t first_;
  Shard own_;
  std::vector<float> values_;
  std::vector<kernels::ChunkTotals> chunks_;
  double off_ = 0;
};

/// The match of one query, at the place `given` or else where its posterior is highest; the same for every
/// member.
SequenceMatch match_by(const Posterior& posterior, const MatrixPart& enhanced, std::size_t query,
                       const std::optional<std::size_t>& given, const SequenceSearchOptions& options,
                       Team& team) {
  Peak peak;
  if (!given) {
    peak = posterior.peak();
  } else if (enhanced.has(*given)) {
    peak = {.value = 1, .reference = *given};
  }
  if (peak.value >= 0) peak.cost = enhanced.own_row(query)[peak.reference - enhanced.own.begin];
  if (team.size() > 1) {
    Peak best;
    for (const std::vector<Peak>& other : exchange_all(team, std::span<const Peak>(&peak, 1)))
      if (other.front().value > best.value) best = other.front();
    peak = best;
  }
  const TreeSum<Odds> own =
      posterior.odds(peak.reference, static_cast<std::size_t>(options.uniqueness_window));
  const Odds odds = sum_of_team(team, own).total();
  return {.reference = peak.reference,
          .cost = peak.cost,
          .score = static_cast<float>(std::log(odds.inside / (posterior.off() + odds.outside))),
          .terms = options.length};
}

/// Matches of the queries of one stretch, at the places `given` or else where they are most probable. The
/// forward pass is made twice, the second time from kept rows, last one first, so that only 3 sqrt(queries)
/// rows need to be kept.
void search_stretch(const MatrixPart& enhanced, const SearchOptions& options, const PathModel& model,
                    Stretch queries, std::span<const SequenceMatch> given, Team& team,
                    std::vector<SequenceMatch>& matches) {
  const std::size_t count = queries.end - queries.begin;
  const auto block = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  std::vector<float> row_likelihoods(enhanced.own.size());
  const auto likelihoods_at = [&](std::size_t i, std::vector<float>& out) {
    out.resize(enhanced.own.size());
    model.likelihoods(enhanced.own_row(queries.begin + i), out);
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
    vo::stop_if_asked();
    likelihoods_at(i, row_likelihoods);
    step(i, row, row_likelihoods, next);
    std::swap(row, next);
  }

  PathModel::Row backward{.on = std::vector<float>(model.width(), 1.0F), .off = 1, .scale = 1};
  PathModel::Row backward_next;
  std::vector<PathModel::Row> rows(block);
  std::vector<std::vector<float>> likelihoods(block);
  std::vector<float> work;
  Posterior posterior(model, enhanced.own);
  for (std::size_t b = kept.size(); b-- > 0;) {
    const std::size_t begin = b * block, end = std::min(count, begin + block);
    for (std::size_t i = begin; i < end; ++i) {
      vo::stop_if_asked();
      likelihoods_at(i, likelihoods[i - begin]);
      step(i, i == begin ? kept[b] : rows[i - begin - 1], likelihoods[i - begin], rows[i - begin]);
    }
    for (std::size_t i = end; i-- > begin;) {
      vo::stop_if_asked();
      posterior.set(rows[i - begin], backward);
      const std::size_t query = queries.begin + i;
      const std::optional<std::size_t> at = given.empty() ? std::nullopt : given[query].reference;
      if (given.empty() || at)
        matches[query] = match_by(posterior, enhanced, query, at, options.sequence, team);
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

/// Matches of all queries, at the places `given` or, if there are none, where they are most probable.
std::vector<SequenceMatch> matches_on_path(const MatrixPart& enhanced, std::span<const SequenceMatch> given,
                                           const SearchOptions& options, Team& team) {
  std::string reason;
  if (!options.path.is_valid(&reason) || !options.sequence.is_valid(&reason))
    throw std::invalid_argument("search_path: " + reason);
  if (!options.path.steps.empty() && options.path.steps.size() != enhanced.queries())
    throw std::invalid_argument("search_path: one step for each query expected");
  std::vector<SequenceMatch> matches(enhanced.queries());
  if (enhanced.queries() == 0 || enhanced.references == 0) return matches;
  const PathModel model(options.path, options.sequence,
                        stretches_between(options.gaps.reference, enhanced.references), enhanced.references,
                        enhanced.own, kTriangle - 1, team);
  const std::vector<Stretch> stretches = stretches_between(options.gaps.query, enhanced.queries());
  const auto search = [&](std::size_t i) {
    search_stretch(enhanced, options, model, stretches[i], given, team, matches);
  };
  if (team.size() == 1) {
    vo::parallel_for(stretches.size(), search);
  } else {  // all members the same one at a time
    for (std::size_t i = 0; i < stretches.size(); ++i) search(i);
  }
  return matches;
}

}  // namespace

SearchResult search_path(const CostView& enhanced, const SearchOptions& options) {
  Alone alone;
  return search_path_part(whole_of(enhanced), options, alone);
}

SearchResult search_path_part(const MatrixPart& enhanced, const SearchOptions& options, Team& team) {
  return {.matches = matches_on_path(enhanced, {}, options, team)};
}

std::vector<SequenceMatch> path_scores(const CostView& enhanced, std::span<const SequenceMatch> matches,
                                       const SearchOptions& options) {
  Alone alone;
  return path_scores_part(whole_of(enhanced), matches, options, alone);
}

std::vector<SequenceMatch> path_scores_part(const MatrixPart& enhanced,
                                            std::span<const SequenceMatch> matches,
                                            const SearchOptions& options, Team& team) {
  const auto is_inside = [&](const SequenceMatch& m) {
    return !m.reference || *m.reference < enhanced.references;
  };
  if (matches.size() != enhanced.queries() || !std::ranges::all_of(matches, is_inside))
    throw std::invalid_argument("path_scores: one match on the reference for each query expected");
  return matches_on_path(enhanced, matches, options, team);
}

}  // namespace place
