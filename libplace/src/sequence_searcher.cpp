#include "place/sequence_searcher.hpp"

#include "kernels/line_sums.hpp"
#include "line_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kRows = 64;  // taken in at a time
constexpr std::size_t kChunk = kernels::kChunk;

constexpr std::size_t chunks_of(std::size_t count) {
  return (count + kChunk - 1) / kChunk;
}

/// The power of two that costs are multiplied by before they are rounded.
float scale_of(const CostRange& range, int length) {
  constexpr int kBits = 30;
  const double largest_sum = range.largest * length;
  if (!(largest_sum > 0)) return 1;
  constexpr int kMostBits = 60;
  return static_cast<float>(
      std::exp2(std::min(kMostBits, kBits - static_cast<int>(std::ceil(std::log2(largest_sum))))));
}

/// What every stretch of the reference goes by.
struct Plan {
  Plan(std::size_t query_count, std::size_t reference_count, const CostRange& range,
       const SequenceSearchOptions& settings)
      : queries(query_count),
        references(reference_count),
        options(settings),
        lines(search_lines(settings)),
        runs(line_runs(lines, query_count, reference_count)),
        centre(static_cast<float>(range.centre)),
        scale(scale_of(range, settings.length)),
        min_terms(std::max(1, static_cast<int>(std::ceil(settings.min_fraction * settings.length)))) {}

  /// Terms of a line that lie inside the matrix are [first, last) of it, as far as queries go.
  [[nodiscard]] int first_term(std::size_t query) const {
    return std::max(0, options.length / 2 - clamped(query));
  }
  [[nodiscard]] int last_term(std::size_t query) const {
    return std::min(options.length, clamped(queries - query) + options.length / 2);
  }
  /// How many of them lie inside the reference too.
  [[nodiscard]] int terms_inside(const SearchLine& line, std::size_t query, std::size_t reference) const {
    const auto first = line.offsets.begin() + first_term(query),
               last = line.offsets.begin() + last_term(query);
    const auto r = static_cast<std::ptrdiff_t>(reference), count = static_cast<std::ptrdiff_t>(references);
    // Offsets never decrease.
    return static_cast<int>(std::lower_bound(first, last, count - r) - std::lower_bound(first, last, -r));
  }
  /// What turns an integer sum of so many terms into a cost.
  [[nodiscard]] float factor(int terms) const {
    return static_cast<float>(1 / (scale * std::sqrt(static_cast<double>(terms) * options.length)));
  }

  std::size_t queries, references;
  SequenceSearchOptions options;
  std::vector<SearchLine> lines;
  SearchRuns runs;
  float centre, scale;
  int min_terms;

 private:
  /// Large enough for every comparison with a length.
  [[nodiscard]] int clamped(std::size_t count) const {
    return static_cast<int>(std::min(count, static_cast<std::size_t>(options.length)));
  }
};

/// The cheapest pair of one query on a stretch of the reference.
struct StretchBest {
  std::size_t reference = 0;
  float cost = kInfinity;
  std::size_t line = 0;
};

/// A stretch of the reference: running sums along each step for the last rows, and the search on them.
class Stretch {
 public:
  Stretch(const Plan& plan, std::size_t begin, std::size_t width)
      : plan_(plan),
        begin_(begin),
        width_(width),
        before_(kLead + static_cast<std::size_t>(-plan.runs.lowest_reference) +
                static_cast<std::size_t>(plan.runs.steps.back())),
        columns_(before_ + chunks_of(width) * kChunk + static_cast<std::size_t>(plan.runs.highest_reference)),
        depth_(static_cast<std::size_t>(plan.runs.highest_query - plan.runs.lowest_query) + 2),
        sums_(plan.runs.steps.size() * depth_ * columns_),
        run_ends_(plan.runs.runs.size()) {
    for (std::size_t chunk = 0; chunk < chunks_of(width_); ++chunk) {
      if (is_edge(chunk)) edges_.push_back({chunk, {}, {}});
    }
    // In the middle of the walk all queries have the same weights.
    if (plan_.queries > 0) weigh_edges(plan_.queries / 2);
  }

  /// Bytes of running sums for each reference.
  static std::size_t bytes_per_reference(const SearchRuns& runs) {
    return runs.steps.size() * static_cast<std::size_t>(runs.highest_query - runs.lowest_query + 2) *
           sizeof(std::uint32_t);
  }

  /// Takes in a row of the matrix, or one past its end where `costs` is null.
  void add_row(std::size_t query, const float* costs) {
    const std::size_t slot = query % depth_, slot_before = (query + depth_ - 1) % depth_;
    const auto first = static_cast<std::ptrdiff_t>(begin_) - static_cast<std::ptrdiff_t>(before_);
    // Columns [inside, past) are references; the others have no cost.
    const std::size_t past =
        std::min(columns_, static_cast<std::size_t>(static_cast<std::ptrdiff_t>(plan_.references) - first));
    const std::size_t inside =
        std::min(past, std::max(kLead, static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -first))));
    for (std::size_t ring = 0; ring < plan_.runs.steps.size(); ++ring) {
      const auto step = static_cast<std::size_t>(plan_.runs.steps[ring]);
      const std::uint32_t* before = row(ring, slot_before) - step;
      std::uint32_t* out = row(ring, slot);
      const auto carry = [&](std::size_t from, std::size_t to) {
        for (std::size_t c = from; c < to; ++c) out[c] = before[c];
      };
      if (costs == nullptr) {
        carry(kLead, columns_);
        continue;
      }
      carry(kLead, inside);
      kernels_.accumulate({costs + (first + static_cast<std::ptrdiff_t>(inside)), plan_.centre, plan_.scale,
                           before + inside, out + inside, past - inside});
      carry(past, columns_);
    }
  }

  /// Finds the best lines of a query, all of whose rows are there.
  StretchBest search(std::size_t query, float* costs, float* chunk_least) {
    const int terms = plan_.last_term(query) - plan_.first_term(query);
    const bool whole = terms == plan_.options.length;
    if (!whole || !weights_are_whole_) weigh_edges(query);
    point_to_rows(query);
    const kernels::LineSums sums{run_ends_.data(), plan_.runs.counts.data(), plan_.lines.size()};
    const float factor = plan_.factor(terms);
    StretchBest best;
    auto edge = edges_.begin();
    for (std::size_t chunk = 0; chunk < chunks_of(width_); ++chunk) {
      float* out = costs + begin_ + chunk * kChunk;
      const Edge* weights = edge != edges_.end() && edge->chunk == chunk ? &*edge++ : nullptr;
      const float least = weights != nullptr
                              ? kernels_.least_weighted(sums, chunk * kChunk, weights->factors.data(),
                                                        weights->terms.data(), out)
                              : kernels_.least(sums, chunk * kChunk, factor, out);
      chunk_least[begin_ / kChunk + chunk] = least;
      if (!(least < best.cost)) continue;
      best.cost = least;
      best.reference =
          begin_ + chunk * kChunk + static_cast<std::size_t>(std::find(out, out + kChunk, least) - out);
      best_edge_ = weights;
    }
    if (best.cost < kInfinity) best.line = line_of(best, factor);
    return best;
  }

 private:
  static constexpr std::size_t kLead = 4;  // columns of 0 that a running sum may begin from; the largest step

  /// A chunk some of whose lines leave the reference.
  struct Edge {
    std::size_t chunk;
    std::vector<float> factors, terms;  ///< see `LineKernels::least_weighted`
  };

  [[nodiscard]] std::uint32_t* row(std::size_t ring, std::size_t slot) {
    return sums_.data() + (ring * depth_ + slot) * columns_;
  }

  [[nodiscard]] bool is_edge(std::size_t chunk) const {
    const std::size_t first = begin_ + chunk * kChunk, past = first + kChunk;
    return first < static_cast<std::size_t>(-plan_.runs.lowest_reference) ||
           past + static_cast<std::size_t>(plan_.runs.highest_reference) > plan_.references;
  }

  void weigh_edges(std::size_t query) {
    weights_are_whole_ = plan_.last_term(query) - plan_.first_term(query) == plan_.options.length;
    for (Edge& edge : edges_) {
      edge.factors.assign(plan_.lines.size() * kChunk, 0.0F);
      edge.terms.assign(plan_.lines.size() * kChunk, kInfinity);
      for (std::size_t i = 0; i < plan_.lines.size() * kChunk; ++i) {
        const std::size_t reference = begin_ + edge.chunk * kChunk + i % kChunk;
        if (reference >= plan_.references) continue;
        const int terms = plan_.terms_inside(plan_.lines[i / kChunk], query, reference);
        if (terms < plan_.min_terms) continue;
        edge.factors[i] = plan_.factor(terms);
        edge.terms[i] = 0;
      }
    }
  }

  /// Sets `run_ends_` to where the running sums of each run end and begin for a query, at the first
  /// reference.
  void point_to_rows(std::size_t query) {
    const auto row_at = [&](std::size_t ring, int along) {
      // Rows before the first are those that were never written: 0.
      return row(ring,
                 (query + depth_ + static_cast<std::size_t>(along + static_cast<int>(depth_))) % depth_) +
             before_;
    };
    for (std::size_t i = 0; i < run_ends_.size(); ++i) {
      const LineRun& run = plan_.runs.runs[i];
      run_ends_[i].last = row_at(run.ring, run.last_query) + run.last_reference;
      run_ends_[i].before =
          row_at(run.ring, run.first_query - 1) + (run.first_reference - plan_.runs.steps[run.ring]);
    }
  }

  /// The first line with the cost that was found to be the least.
  [[nodiscard]] std::size_t line_of(const StretchBest& best, float factor) const {
    const std::size_t column = best.reference - begin_;
    auto run = run_ends_.begin();
    for (std::size_t line = 0; line < plan_.lines.size(); ++line) {
      std::uint32_t sum = 0;
      for (std::uint32_t left = plan_.runs.counts[line]; left > 0; --left, ++run)
        sum += run->last[column] - run->before[column];
      const auto value = static_cast<float>(static_cast<std::int32_t>(sum));
      const std::size_t at = line * kChunk + column % kChunk;
      const float cost =
          best_edge_ != nullptr ? value * best_edge_->factors[at] + best_edge_->terms[at] : value * factor;
      if (cost == best.cost) return line;
    }
    return 0;
  }

  const Plan& plan_;
  const kernels::LineKernels& kernels_ = kernels::line_kernels();
  std::size_t begin_, width_;
  std::size_t before_;   ///< columns left of the first reference
  std::size_t columns_;  ///< of a row
  std::size_t depth_;    ///< rows that are kept
  std::vector<std::uint32_t> sums_;
  std::vector<kernels::RunEnds> run_ends_;
  std::vector<Edge> edges_;
  const Edge* best_edge_ = nullptr;
  bool weights_are_whole_ = false;
};

/// How many references a stretch has: so that its running sums fit the second-level cache.
std::size_t stretch_width(const SearchRuns& runs) {
  constexpr std::size_t kBytes = 1U << 17U, kLeast = 256, kMost = 1024;
  const std::size_t margin = static_cast<std::size_t>(runs.highest_reference - runs.lowest_reference);
  const std::size_t fitting = kBytes / Stretch::bytes_per_reference(runs) / kChunk * kChunk;
  return std::clamp(fitting, std::max(kLeast, chunks_of(2 * margin) * kChunk),
                    std::max(kMost, chunks_of(2 * margin) * kChunk));
}

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

  Plan plan_;
  std::vector<Stretch> stretches_;
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
