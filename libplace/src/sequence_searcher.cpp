#include "place/sequence_searcher.hpp"

#include "search_stretch.hpp"

#include <algorithm>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr std::size_t kRows = 64;  // taken in at a time

}  // namespace

class SequenceSearcher::Search {
 public:
  Search(std::size_t queries, std::size_t references, const CostRange& range,
         const SequenceSearchOptions& options)
      : plan_(queries, references, range, options), matches_(queries) {
    if (queries == 0 || references == 0) return;
    const std::size_t width = stretch_width(plan_.runs);
    for (std::size_t begin = 0; begin < references; begin += width)
      stretches_.emplace_back(plan_, begin, std::min(width, references - begin));
    const std::size_t chunks = chunks_of(references);
    costs_.resize(kRows * chunks * kChunk);
    chunk_least_.resize(kRows * chunks);
    best_.resize(kRows * stretches_.size());
  }

  void push(std::span<const float> rows) {
    if (plan_.references == 0) return;
    if (rows.size() % plan_.references != 0 || rows.size() / plan_.references > plan_.queries - pushed_) {
      throw std::invalid_argument("SequenceSearcher: whole rows, as many as there are queries, expected");
    }
    const std::size_t count = rows.size() / plan_.references;
    for (std::size_t i = 0; i < count; i += kRows) {
      take(rows.data() + i * plan_.references, std::min(kRows, count - i));
    }
  }

  std::vector<SequenceMatch> finish() {
    if (plan_.references == 0) return std::move(matches_);
    if (pushed_ != plan_.queries) throw std::invalid_argument("SequenceSearcher: rows are missing");
    const std::size_t end = plan_.queries + ahead();
    for (std::size_t row = plan_.queries; row < end; row += kRows) take(nullptr, std::min(kRows, end - row));
    return std::move(matches_);
  }

 private:
  /// Rows past a query's own that its lines need.
  [[nodiscard]] std::size_t ahead() const { return static_cast<std::size_t>(plan_.runs.highest_query); }

  /// Takes in rows, or rows past the end where `rows` is null, and matches the queries that they complete.
  void take(const float* rows, std::size_t count) {
    const std::size_t first_row = pushed_;
    const auto completed = [&](std::size_t row) { return row >= ahead() && row - ahead() < plan_.queries; };
    vo::parallel_for(stretches_.size(), [&](std::size_t s) {
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t row = first_row + i;
        stretches_[s].add_row(row, rows == nullptr ? nullptr : rows + i * plan_.references);
        if (completed(row) && can_match(row - ahead())) {
          best_[i * stretches_.size() + s] =
              stretches_[s].search(row - ahead(), costs_of(i).data(), chunk_least_of(i).data());
        }
      }
    });
    vo::parallel_for(count, [&](std::size_t i) {
      if (completed(first_row + i) && can_match(first_row + i - ahead())) decide(first_row + i - ahead(), i);
    });
    pushed_ += count;
  }

  [[nodiscard]] bool can_match(std::size_t query) const {
    return plan_.last_term(query) - plan_.first_term(query) >= plan_.min_terms;
  }

  /// Of the stretches' best, the best; and how much better than any outside the uniqueness window.
  void decide(std::size_t query, std::size_t i) {
    const std::span<const StretchBest> candidates =
        std::span(best_).subspan(i * stretches_.size(), stretches_.size());
    const StretchBest& best = *std::ranges::min_element(candidates, {}, &StretchBest::cost);
    if (best.cost == kInfinity) return;
    const std::size_t r = best.reference, window = static_cast<std::size_t>(plan_.options.uniqueness_window);
    float second = r > window ? least_of(i, 0, r - window) : kInfinity;
    if (r + window + 1 < plan_.references)
      second = std::min(second, least_of(i, r + window + 1, plan_.references));
    SequenceMatch& match = matches_[query];
    match.reference = r;
    match.slope = plan_.lines[best.line].slope;
    match.cost = best.cost;
    match.score = (second == kInfinity ? 0 : second) - best.cost;
    match.terms = plan_.terms_inside(plan_.lines[best.line], query, r);
  }

  /// The least cost of references [begin, end).
  float least_of(std::size_t i, std::size_t begin, std::size_t end) {
    const std::span<const float> costs = costs_of(i), chunks = chunk_least_of(i);
    const auto least = [](std::span<const float> values) {
      return values.empty() ? kInfinity : *std::ranges::min_element(values);
    };
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
  std::vector<SearchStretch> stretches_;
  std::vector<SequenceMatch> matches_;
  std::vector<float> costs_, chunk_least_;  // of kRows queries
  std::vector<StretchBest> best_;           // of kRows queries, each stretch
  std::size_t pushed_ = 0;                  // rows, those past the end too
};

SequenceSearcher::SequenceSearcher(std::size_t queries, std::size_t references, const CostRange& range,
                                   const SequenceSearchOptions& options)
    : search_(std::make_unique<Search>(queries, references, range, options)) {}
SequenceSearcher::~SequenceSearcher() = default;
SequenceSearcher::SequenceSearcher(SequenceSearcher&&) noexcept = default;
SequenceSearcher& SequenceSearcher::operator=(SequenceSearcher&&) noexcept = default;

void SequenceSearcher::push(std::span<const float> rows) {
  search_->push(rows);
}

std::vector<SequenceMatch> SequenceSearcher::finish() {
  return search_->finish();
}

}  // namespace place
