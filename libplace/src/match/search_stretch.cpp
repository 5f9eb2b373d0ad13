#include "match/search_stretch.hpp"

namespace place {
namespace {

/// The power of two that costs are multiplied by before rounding.
float scale_of(const CostRange& range, int length) {
  constexpr int kBits = 30;
  const double largest_sum = range.largest * length;
  if (!(largest_sum > 0)) return 1;
  constexpr int kMostBits = 60;
  return static_cast<float>(
      std::exp2(std::min(kMostBits, kBits - static_cast<int>(std::ceil(std::log2(largest_sum))))));
}

/// Bytes of running sums for each reference.
std::size_t bytes_per_reference(const SearchRuns& runs) {
  return runs.steps.size() * static_cast<std::size_t>(runs.highest_query - runs.lowest_query + 2) *
         sizeof(std::uint32_t);
}

}  // namespace

SearchPlan::SearchPlan(std::size_t query_count, std::size_t reference_count, const CostRange& range,
                       const SequenceSearchOptions& settings)
    : queries(query_count),
      references(reference_count),
      options(settings),
      lines(search_lines(settings)),
      runs(line_runs(lines, query_count, reference_count)),
      centre(static_cast<float>(range.centre)),
      scale(scale_of(range, settings.length)),
      min_terms(std::max(1, static_cast<int>(std::ceil(settings.min_fraction * settings.length)))) {}

int SearchPlan::terms_inside(const SearchLine& line, std::size_t query, std::size_t reference) const {
  const auto first = line.offsets.begin() + first_term(query), last = line.offsets.begin() + last_term(query);
  const auto r = static_cast<std::ptrdiff_t>(reference), count = static_cast<std::ptrdiff_t>(references);
  // Offsets never decrease.
  return static_cast<int>(std::lower_bound(first, last, count - r) - std::lower_bound(first, last, -r));
}
SearchStretch::SearchStretch(const SearchPlan& plan, std::size_t begin, std::size_t width)
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

void SearchStretch::add_row(std::size_t query, std::size_t first, std::span<const float> costs) {
  const std::size_t slot = query % depth_, slot_before = (query + depth_ - 1) % depth_;
  // Columns [inside, past) have costs. For the others only differences of 0 are taken.
  const auto column = [&](std::size_t reference) {
    const auto at = static_cast<std::ptrdiff_t>(reference + before_) - static_cast<std::ptrdiff_t>(begin_);
    return static_cast<std::size_t>(
        std::clamp(at, static_cast<std::ptrdiff_t>(kLead), static_cast<std::ptrdiff_t>(columns_)));
  };
  const std::size_t inside = column(first), past = column(first + costs.size());
  for (std::size_t ring = 0; ring < plan_.runs.steps.size(); ++ring) {
    const auto step = static_cast<std::size_t>(plan_.runs.steps[ring]);
    const std::uint32_t* before = row(ring, slot_before) - step;
    std::uint32_t* out = row(ring, slot);
    const auto carry = [&](std::size_t from, std::size_t to) {
      for (std::size_t c = from; c < to; ++c) out[c] = before[c];
    };
    carry(kLead, inside);
    if (inside < past)
      kernels_.accumulate({costs.data() + (inside + begin_ - before_ - first), plan_.centre, plan_.scale,
                           before + inside, out + inside, past - inside});
    carry(past, columns_);
  }
}

StretchBest SearchStretch::search(std::size_t query, float* costs, float* chunk_least) {
  const int terms = plan_.last_term(query) - plan_.first_term(query);
  const bool whole = terms == plan_.options.length;
  if (!whole || !weights_are_whole_) weigh_edges(query);
  point_to_rows(query);
  const kernels::LineSums sums{run_ends_.data(), plan_.runs.counts.data(), plan_.lines.size()};
  const float factor = plan_.factor(terms);
  StretchBest best;
  auto edge = edges_.begin();
  for (std::size_t chunk = 0; chunk < chunks_of(width_); ++chunk) {
    float* out = costs + chunk * kChunk;
    const Edge* weights = edge != edges_.end() && edge->chunk == chunk ? &*edge++ : nullptr;
    const float least = weights != nullptr
                            ? kernels_.least_weighted(sums, chunk * kChunk, weights->factors.data(),
                                                      weights->terms.data(), out)
                            : kernels_.least(sums, chunk * kChunk, factor, out);
    chunk_least[chunk] = least;
    if (!(least < best.cost)) continue;
    best.cost = least;
    best.reference =
        begin_ + chunk * kChunk + static_cast<std::size_t>(std::find(out, out + kChunk, least) - out);
    best_edge_ = weights;
  }
  if (best.cost < kUnreached) best.line = line_of(best, factor);
  return best;
}

bool SearchStretch::is_edge(std::size_t chunk) const {
  const std::size_t first = begin_ + chunk * kChunk, past = first + kChunk;
  return first < static_cast<std::size_t>(-plan_.runs.lowest_reference) ||
         past + static_cast<std::size_t>(plan_.runs.highest_reference) > plan_.references;
}

void SearchStretch::weigh_edges(std::size_t query) {
  weights_are_whole_ = plan_.last_term(query) - plan_.first_term(query) == plan_.options.length;
  for (Edge& edge : edges_) {
    edge.factors.assign(plan_.lines.size() * kChunk, 0.0F);
    edge.terms.assign(plan_.lines.size() * kChunk, kUnreached);
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

void SearchStretch::point_to_rows(std::size_t query) {
  const auto row_at = [&](std::size_t ring, int along) {
    // Rows before the first were never written: 0.
    return row(ring, (query + depth_ + static_cast<std::size_t>(along + static_cast<int>(depth_))) % depth_) +
           before_;
  };
  for (std::size_t i = 0; i < run_ends_.size(); ++i) {
    const LineRun& run = plan_.runs.runs[i];
    run_ends_[i].last = row_at(run.ring, run.last_query) + run.last_reference;
    run_ends_[i].before =
        row_at(run.ring, run.first_query - 1) + (run.first_reference - plan_.runs.steps[run.ring]);
  }
}

std::size_t SearchStretch::line_of(const StretchBest& best, float factor) const {
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

std::size_t stretch_width(const SearchRuns& runs) {
  constexpr std::size_t kBytes = 1U << 17U, kLeast = 256, kMost = 1024;
  const std::size_t margin = static_cast<std::size_t>(runs.highest_reference - runs.lowest_reference);
  const std::size_t fitting = kBytes / bytes_per_reference(runs) / kChunk * kChunk;
  return std::clamp(fitting, std::max(kLeast, chunks_of(2 * margin) * kChunk),
                    std::max(kMost, chunks_of(2 * margin) * kChunk));
}

}  // namespace place
