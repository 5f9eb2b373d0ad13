#include "place/match/search_hybrid.hpp"

#include "match/cone_shape.hpp"
#include "match/row_minimum.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The least of every `width` neighbours in a row of costs that overlap it.
class SlidingMinima {
 public:
  /// For windows that begin at or after -margin and end before size + margin.
  SlidingMinima(std::size_t size, std::size_t margin) : margin_(margin), size_(size + 2 * margin) {
    padded_.assign(size_, kInfinity);
  }

  void set_row(std::span<const float> row) {
    std::ranges::copy(row, padded_.begin() + static_cast<std::ptrdiff_t>(margin_));
    done_.clear();
  }

  /// Minima of `width` neighbours; the window that begins at reference r is at [r] of the result, from
  /// -margin on.
  const float* of_width(std::size_t width) {
    // The least of 2^n neighbours is that of two windows of 2^(n-1); for a width in between, of two
    // overlapping windows.
    std::size_t power = 1;
    const float* minima = padded_.data();
    while (2 * power <= width) {
      minima = step(minima, 2 * power, power, 2 * power);
      power *= 2;
    }
    if (power < width) minima = step(minima, width, width - power, width);
    return minima + margin_;
  }

 private:
  const float* step(const float* from, std::size_t key, std::size_t apart, std::size_t width) {
    auto [done, is_new] = done_.try_emplace(key, false);
    std::vector<float>& minima = kept_[key];
    if (is_new) {
      minima.resize(size_, kInfinity);
      const std::size_t count = size_ - std::min(size_, width - 1);
      const float* a = from;
      const float* b = from + apart;
      for (std::size_t i = 0; i < count; ++i) minima[i] = a[i] < b[i] ? a[i] : b[i];
    }
    return minima.data();
  }

  std::size_t margin_, size_;
  std::vector<float> padded_;
  std::map<std::size_t, bool> done_;
  std::map<std::size_t, std::vector<float>> kept_;  // by width
};

/// The costs of every pair of some successive queries.
class HybridBlock {
 public:
  HybridBlock(const CostView& enhanced, const ConeShape& shape, std::size_t begin, std::size_t count)
      : enhanced_(enhanced),
        shape_(shape),
        begin_(begin),
        count_(count),
        sums_(count * enhanced.references, 0.0F) {}

  void add_rows() {
    std::ptrdiff_t margin = 0;
    for (const ConeShape::Row& row : shape_.rows()) margin = std::max({margin, -row.low, row.high});
    SlidingMinima minima(enhanced_.references, static_cast<std::size_t>(margin));
    const auto begin = static_cast<std::ptrdiff_t>(begin_), count = static_cast<std::ptrdiff_t>(count_);
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, begin + shape_.rows().front().along);
    const std::ptrdiff_t past =
        std::min(static_cast<std::ptrdiff_t>(enhanced_.queries), begin + count + shape_.rows().back().along);
    for (std::ptrdiff_t q = first; q < past; ++q) {
      minima.set_row(enhanced_.row(static_cast<std::size_t>(q)));
      for (const ConeShape::Row& row : shape_.rows()) {
        const std::ptrdiff_t of = q - row.along - begin;
        if (of < 0 || of >= count) continue;
        const auto [from, to] = shape_.touching(row);
        const float* least = minima.of_width(row.width()) + row.low;
        float* sum = sums_.data() + static_cast<std::size_t>(of) * enhanced_.references;
        for (std::size_t r = from; r < to; ++r) sum[r] += least[r];
      }
    }
  }

  SequenceMatch match(std::size_t query, std::size_t window) {
    const std::span<float> costs =
        std::span(sums_).subspan((query - begin_) * enhanced_.references, enhanced_.references);
    // Between these references, every row that has a query touches the reference.
    std::size_t from = 0, to = costs.size();
    int whole = 0;
    for (const ConeShape::Row& row : shape_.rows()) {
      const auto [first, past] = shape_.touching(row);
      from = std::max(from, first);
      to = std::min(to, past);
      whole += static_cast<int>(shape_.has_query(query, row));
    }
    from = std::min(from, costs.size());
    to = std::max(from, to);
    const auto weigh = [&](std::size_t r) {
      const int terms = shape_.terms(query, r);
      costs[r] = shape_.enough(terms) ? costs[r] * shape_.factor(terms) : kInfinity;
    };
    for (std::size_t r = 0; r < from; ++r) weigh(r);
    for (std::size_t r = to; r < costs.size(); ++r) weigh(r);
    if (shape_.enough(whole)) {
      const float factor = shape_.factor(whole);
      for (std::size_t r = from; r < to; ++r) costs[r] *= factor;
    } else {
      std::fill(costs.begin() + static_cast<std::ptrdiff_t>(from),
                costs.begin() + static_cast<std::ptrdiff_t>(to), kInfinity);
    }
    const RowMinimum best = row_minimum(costs);
    if (best.reference >= costs.size()) return {};
    const float elsewhere = minimum_outside(costs, best.reference, window);
    return {.reference = best.reference,
            .cost = best.cost,
            .score = (elsewhere < kInfinity ? elsewhere : 0) - best.cost,
            .terms = shape_.terms(query, best.reference)};
  }

 private:
  CostView enhanced_;
  const ConeShape& shape_;
  std::size_t begin_, count_;
  std::vector<float> sums_;
};

}  // namespace

std::vector<SequenceMatch> search_hybrid(const CostView& enhanced, const SequenceSearchOptions& options) {
  const ConeShape shape(options, enhanced.queries, enhanced.references);
  // Sums run over whole rows in the order of the queries, so the result does not depend on the blocks.
  constexpr std::size_t kBytes = 1U << 20U, kFewest = 8, kMost = 64;
  const std::size_t block =
      std::clamp(kBytes / sizeof(float) / std::max<std::size_t>(1, enhanced.references), kFewest, kMost);
  std::vector<SequenceMatch> matches(enhanced.queries);
  vo::parallel_for((enhanced.queries + block - 1) / block, [&](std::size_t i) {
    const std::size_t begin = i * block, count = std::min(block, enhanced.queries - begin);
    HybridBlock costs(enhanced, shape, begin, count);
    costs.add_rows();
    for (std::size_t q = begin; q < begin + count; ++q)
      matches[q] = costs.match(q, static_cast<std::size_t>(options.uniqueness_window));
  });
  return matches;
}

}  // namespace place
