#include "place/match/sequence_searcher.hpp"

#include "match/search_stretch.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr std::size_t kRows = 64;  // added at a time
static_assert(SequenceSearcher::kPart % kChunk == 0);

}  // namespace

class SequenceSearcher::Search {
 public:
  Search(std::size_t queries, std::size_t references, const CostRange& range,
         const SequenceSearchOptions& options)
      : plan_(queries, references, range, options),
        margin_(reach_of(plan_.lines)),
        window_(std::min(references, static_cast<std::size_t>(options.uniqueness_window))),
        found_(queries) {}

  [[nodiscard]] std::size_t margin() const { return margin_; }

  void push(const ConstCosts& costs, std::size_t count) {
    const std::size_t past = searched_ + count, given_past = costs.first_reference + costs.references;
    const bool last = past == plan_.references;
    if (past > plan_.references || costs.queries != plan_.queries ||
        costs.first_reference > searched_ - std::min(searched_, margin_) ||
        given_past < std::min(plan_.references, past + margin_) ||
        (!last && (count % kPart != 0 || count < window_))) {
      throw std::invalid_argument(
          "SequenceSearcher: parts of the reference by all queries, in order, expected");
    }
    search(costs, count);
  }

  std::vector<OnShard> search_shard(const ConstCosts& costs, const Shard& own) {
    if (own.end > plan_.references || costs.queries != plan_.queries ||
        costs.first_reference > own.begin - std::min(own.begin, margin_) ||
        costs.first_reference + costs.references < std::min(plan_.references, own.end + margin_))
      throw std::invalid_argument("SequenceSearcher: a shard of the reference by all queries expected");
    const OnShard nothing{.best = {},
                          .elsewhere = kUnreached,
                          .head = {},
                          .tail = {},
                          .after_head = kUnreached,
                          .before_tail = kUnreached};
    on_shard_ = std::vector<OnShard>(plan_.queries, nothing);
    searched_ = own.begin;
    search(costs, own.size());
    std::vector<OnShard>& found = *on_shard_;
    const std::vector<SequenceMatch> matches = matches_so_far();
    for (std::size_t q = 0; q < found.size(); ++q) {
      found[q].best = matches[q];
      found[q].elsewhere = found_[q].elsewhere;
    }
    return std::move(found);
  }

  std::vector<SequenceMatch> finish() const {
    if (plan_.queries > 0 && searched_ != plan_.references)
      throw std::invalid_argument("SequenceSearcher: references are missing");
    return matches_so_far();
  }

 private:
  /// The best of the parts searched so far for a query.
  struct Found {
    StretchBest best;
    float elsewhere = kUnreached;     ///< the least cost outside the best one's window
    std::vector<float> latest;        ///< costs of the last references, as many as a window has
    float before_those = kUnreached;  ///< the least cost before those
  };

  /// The next `count` references.
  void search(const ConstCosts& costs, std::size_t count) {
    if (count == 0 || plan_.queries == 0) return;
    begin_ = searched_;
    searched_ += count;
    stretches_.clear();
    const std::size_t width = stretch_width(plan_.runs);
    for (std::size_t begin = begin_; begin < searched_; begin += width)
      stretches_.emplace_back(plan_, begin, std::min(width, searched_ - begin));
    costs_.resize(kRows * chunks_of(count) * kChunk);
    chunk_least_.resize(kRows * chunks_of(count));
    best_.resize(kRows * stretches_.size());
    // Rows past the last query's own complete the last queries.
    const std::size_t end = plan_.queries + ahead();
    for (std::size_t row = 0; row < end; row += kRows) take(costs, row, std::min(kRows, end - row));
  }

  [[nodiscard]] std::vector<SequenceMatch> matches_so_far() const {
    std::vector<SequenceMatch> matches(plan_.queries);
    for (std::size_t q = 0; q < matches.size(); ++q) {
      const Found& found = found_[q];
      if (found.best.cost == kUnreached) continue;
      const SearchLine& line = plan_.lines[found.best.line];
      matches[q] = {.reference = found.best.reference,
                    .slope = line.slope,
                    .cost = found.best.cost,
                    .score = (found.elsewhere == kUnreached ? 0 : found.elsewhere) - found.best.cost,
                    .terms = plan_.terms_inside(line, q, found.best.reference)};
    }
    return matches;
  }

  /// Rows past a query's own that its lines need.
  [[nodiscard]] std::size_t ahead() const { return static_cast<std::size_t>(plan_.runs.highest_query); }

  /// Adds rows and matches the queries that they complete.
  void take(const ConstCosts& costs, std::size_t first_row, std::size_t count) {
    const auto completes_one = [&](std::size_t row) {
      return row >= ahead() && row - ahead() < plan_.queries && can_match(row - ahead());
    };
    vo::parallel_for(stretches_.size(), [&](std::size_t s) {
      const std::size_t at = stretches_[s].begin() - begin_;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t row = first_row + i;
        stretches_[s].add_row(row, costs.first_reference,
                              row < plan_.queries ? costs.row(row) : std::span<const float>());
        if (!completes_one(row)) continue;
        best_[i * stretches_.size() + s] = stretches_[s].search(row - ahead(), costs_of(i).data() + at,
                                                                chunk_least_of(i).data() + at / kChunk);
      }
    });
    vo::parallel_for(count, [&](std::size_t i) {
      if (completes_one(first_row + i)) decide(found_[first_row + i - ahead()], i);
    });
  }

  [[nodiscard]] bool can_match(std::size_t query) const {
    return plan_.last_term(query) - plan_.first_term(query) >= plan_.min_terms;
  }

  /// The best over all stretches, and the least cost outside its window.
  void decide(Found& found, std::size_t i) {
    const StretchBest& best = *std::ranges::min_element(
        std::span(best_).subspan(i * stretches_.size(), stretches_.size()), {}, &StretchBest::cost);
    if (best.cost < found.best.cost) {
      found.best = best;
      found.elsewhere = found.before_those;
      // Of the latest, those outside its window, which reaches no further back.
      const std::size_t within =
          std::min(found.latest.size(), window_ - std::min(window_, best.reference - begin_));
      found.elsewhere =
          std::min(found.elsewhere, least(std::span(found.latest).first(found.latest.size() - within)));
      if (best.reference - begin_ > window_)
        found.elsewhere = std::min(found.elsewhere, least_of(i, begin_, best.reference - window_));
    }
    const std::size_t after = std::max(begin_, found.best.reference + window_ + 1);
    if (found.best.cost < kUnreached && after < searched_)
      found.elsewhere = std::min(found.elsewhere, least_of(i, after, searched_));
    if (on_shard_ && searched_ - begin_ < plan_.references) {
      note_ends((*on_shard_)[static_cast<std::size_t>(&found - found_.data())], i);
      return;
    }
    if (searched_ == plan_.references) return;
    found.before_those =
        std::min({found.before_those, least(found.latest), least_of(i, begin_, searched_ - window_)});
    const std::span<const float> latest = costs_of(i).subspan(searched_ - window_ - begin_, window_);
    found.latest.assign(latest.begin(), latest.end());
  }

  /// The costs that a member of a team says of its shard.
  void note_ends(OnShard& shard, std::size_t i) {
    const std::span<const float> costs = costs_of(i).first(searched_ - begin_);
    const std::size_t ends = std::min(window_, costs.size());
    shard.head.assign(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(ends));
    shard.tail.assign(costs.end() - static_cast<std::ptrdiff_t>(ends), costs.end());
    shard.after_head = least_of(i, begin_ + ends, searched_);
    shard.before_tail = least_of(i, begin_, searched_ - ends);
  }

  static float least(std::span<const float> values) {
    return values.empty() ? kUnreached : *std::ranges::min_element(values);
  }

  /// The least cost of references [begin, end) of the part.
  float least_of(std::size_t i, std::size_t begin, std::size_t end) {
    const std::span<const float> costs = costs_of(i), chunks = chunk_least_of(i);
    begin -= begin_;
    end -= begin_;
    const std::size_t first = chunks_of(begin), last = end / kChunk;
    if (first >= last) return least(costs.subspan(begin, end - begin));
    return std::min({least(costs.subspan(begin, first * kChunk - begin)),
                     least(chunks.subspan(first, last - first)),
                     least(costs.subspan(last * kChunk, end - last * kChunk))});
  }

  [[nodiscard]] std::span<float> costs_of(std::size_t i) {
    const std::size_t size = costs_.size() / kRows;
    return std::span(costs_).subspan(i * size, size);
  }
  [[nodiscard]] std::span<float> chunk_least_of(std::size_t i) {
    const std::size_t size = chunk_least_.size() / kRows;
    return std::span(chunk_least_).subspan(i * size, size);
  }

  SearchPlan plan_;
  std::size_t margin_, window_;  ///< references on either side
  std::vector<Found> found_;
  std::size_t searched_ = 0;  ///< references, including those of the part
  std::optional<std::vector<OnShard>> on_shard_;
  // Of the part that is being searched:
  std::size_t begin_ = 0;
  std::vector<SearchStretch> stretches_;
  std::vector<float> costs_, chunk_least_;  // of kRows queries
  std::vector<StretchBest> best_;           // of kRows queries, each stretch
};

SequenceSearcher::SequenceSearcher(std::size_t queries, std::size_t references, const CostRange& range,
                                   const SequenceSearchOptions& options)
    : search_(std::make_unique<Search>(queries, references, range, options)) {}
SequenceSearcher::~SequenceSearcher() = default;
SequenceSearcher::SequenceSearcher(SequenceSearcher&&) noexcept = default;
SequenceSearcher& SequenceSearcher::operator=(SequenceSearcher&&) noexcept = default;

std::size_t SequenceSearcher::margin() const {
  return search_->margin();
}

void SequenceSearcher::push(const ConstCosts& costs, std::size_t count) {
  search_->push(costs, count);
}

std::vector<SequenceSearcher::OnShard> SequenceSearcher::search_shard(const ConstCosts& costs,
                                                                      const Shard& own) {
  return search_->search_shard(costs, own);
}

std::vector<SequenceMatch> SequenceSearcher::finish() {
  return search_->finish();
}

}  // namespace place
