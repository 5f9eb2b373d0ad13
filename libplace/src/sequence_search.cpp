#include "place/sequence_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr double kLargestRangeRad = 0.78;  // slope 185
constexpr double kLargestSlope = 200;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The cheapest line through each reference, for one query.
struct BestLines {
  std::vector<float> cost;
  std::vector<int> line;
  std::vector<int> terms;

  explicit BestLines(std::size_t references) : cost(references), line(references), terms(references) {}
  void clear() { std::ranges::fill(cost, kInfinity); }
  void offer(std::size_t r, float candidate, int candidate_line, int candidate_terms) {
    if (!(candidate < cost[r])) return;
    cost[r] = candidate;
    line[r] = candidate_line;
    terms[r] = candidate_terms;
  }
};

/// Searches all lines through one query at a time.
class QuerySearch {
 public:
  QuerySearch(const CostMatrix& enhanced, const std::vector<SearchLine>& lines,
              const SequenceSearchOptions& options, float centre)
      : enhanced_(enhanced),
        lines_(lines),
        length_(options.length),
        min_terms_(std::max(1, static_cast<int>(std::ceil(options.min_fraction * options.length)))),
        window_(static_cast<std::size_t>(options.uniqueness_window)),
        centre_(centre),
        sums_(enhanced.references),
        best_(enhanced.references) {}

  SequenceMatch operator()(std::size_t query) {
    best_.clear();
    for (std::size_t i = 0; i < lines_.size(); ++i) add_line(query, static_cast<int>(i));
    return uniquely_best();
  }

 private:
  /// Sums one line through (query, r) for every r at once: each term adds a stretch of a row, shifted.
  void add_line(std::size_t query, int index) {
    const std::vector<int>& offsets = lines_[static_cast<std::size_t>(index)].offsets;
    const auto q = static_cast<int>(query);
    const auto queries = static_cast<int>(enhanced_.queries);
    const auto references = static_cast<int>(enhanced_.references);
    const int half = length_ / 2;
    const int first = std::max(0, half - q);  // terms before the query walk's start are left out
    const int last = std::min(length_, queries - q + half);  // and those past its end
    std::ranges::fill(sums_, 0.0F);
    for (int k = first; k < last; ++k) {
      const int offset = offsets[static_cast<std::size_t>(k)];
      const float* row = enhanced_.row(static_cast<std::size_t>(q + k - half)).data();
      const int begin = std::max(0, -offset);
      const int end = std::min(references, references - offset);
      float* sums = sums_.data();
      for (int r = begin; r < end; ++r) sums[r] += row[r + offset];
    }

    // Offsets never decrease, so every reference in [inner_begin, inner_end) has all its terms.
    const int lowest = offsets[static_cast<std::size_t>(first)];
    const int highest = offsets[static_cast<std::size_t>(last) - 1];
    const int inner_begin = std::min(references, std::max(0, -lowest));
    const int inner_end = std::max(inner_begin, std::min(references, references - highest));
    const auto offer = [&](int r, int terms) {
      if (terms < min_terms_) return;
      const auto n = static_cast<float>(terms);
      const float cost =
          (sums_[static_cast<std::size_t>(r)] - n * centre_) / std::sqrt(n * static_cast<float>(length_));
      best_.offer(static_cast<std::size_t>(r), cost, index, terms);
    };
    const auto terms_inside = [&](int r) {
      return static_cast<int>(std::count_if(offsets.begin() + first, offsets.begin() + last, [&](int offset) {
        return r + offset >= 0 && r + offset < references;
      }));
    };
    for (int r = 0; r < inner_begin; ++r) offer(r, terms_inside(r));
    for (int r = inner_begin; r < inner_end; ++r) offer(r, last - first);
    for (int r = inner_end; r < references; ++r) offer(r, terms_inside(r));
  }

  [[nodiscard]] SequenceMatch uniquely_best() const {
    SequenceMatch match;
    const auto best = std::ranges::min_element(best_.cost);
    if (best == best_.cost.end() || *best == kInfinity) return match;
    const auto r = static_cast<std::size_t>(best - best_.cost.begin());
    float second = kInfinity;
    for (std::size_t other = 0; other < best_.cost.size(); ++other) {
      if (other + window_ < r || other > r + window_) second = std::min(second, best_.cost[other]);
    }
    match.reference = r;
    match.slope = lines_[static_cast<std::size_t>(best_.line[r])].slope;
    match.cost = *best;
    match.score = (second == kInfinity ? 0 : second) - *best;
    match.terms = best_.terms[r];
    return match;
  }

  const CostMatrix& enhanced_;
  const std::vector<SearchLine>& lines_;
  int length_;
  int min_terms_;
  std::size_t window_;
  float centre_;
  std::vector<float> sums_;
  BestLines best_;
};

std::vector<double> slopes_of(const SequenceSearchOptions& options) {
  std::vector<double> slopes;
  if (options.v_min) {
    const int steps = static_cast<int>(std::floor((*options.v_max - *options.v_min) * options.length + 1e-9));
    for (int i = 0; i <= steps; ++i)
      slopes.push_back(*options.v_min + static_cast<double>(i) / options.length);
  } else {
    for (int i = 0; i < options.slopes; ++i) {
      const double share = options.slopes == 1 ? 0 : 2.0 * i / (options.slopes - 1) - 1;
      slopes.push_back(std::tan(std::numbers::pi / 4 + share * options.search_range_rad));
    }
  }
  return slopes;
}

}  // namespace

bool SequenceSearchOptions::is_valid(std::string* reason) const {
  const auto invalid = [&](std::string text) {
    if (reason != nullptr) *reason = std::move(text);
    return false;
  };
  if (length < 1) return invalid(fmt::format("sequence length is {}; at least 1 expected", length));
  if (!(search_range_rad >= 0 && search_range_rad <= kLargestRangeRad)) {
    return invalid(
        fmt::format("search range is {} rad; 0 <= range <= {} expected", search_range_rad, kLargestRangeRad));
  }
  if (slopes < 1) return invalid(fmt::format("slopes is {}; at least 1 expected", slopes));
  if (v_min.has_value() != v_max.has_value())
    return invalid("v_min and v_max go together; both or neither expected");
  if (v_min && !(*v_min > 0 && *v_min <= *v_max && *v_max <= kLargestSlope)) {
    return invalid(fmt::format("velocities are {}..{}; 0 < v_min <= v_max <= {} expected", *v_min, *v_max,
                               kLargestSlope));
  }
  if (!(min_fraction > 0 && min_fraction <= 1)) {
    return invalid(fmt::format("min fraction is {}; 0 < fraction <= 1 expected", min_fraction));
  }
  if (uniqueness_window < 0)
    return invalid(fmt::format("uniqueness window is {}; >= 0 expected", uniqueness_window));
  return true;
}

std::vector<SearchLine> search_lines(const SequenceSearchOptions& options) {
  if (std::string reason; !options.is_valid(&reason)) throw std::invalid_argument("search_lines: " + reason);
  std::vector<SearchLine> lines;
  for (const double slope : slopes_of(options)) {
    SearchLine line{.slope = slope, .offsets = {}};
    for (int k = 0; k < options.length; ++k) {
      line.offsets.push_back(static_cast<int>(std::lround((k - options.length / 2) * slope)));
    }
    if (lines.empty() || lines.back().offsets != line.offsets) lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<SequenceMatch> search_sequences(const CostMatrix& enhanced,
                                            const SequenceSearchOptions& options) {
  const std::vector<SearchLine> lines = search_lines(options);
  std::vector<SequenceMatch> matches(enhanced.queries);
  if (enhanced.values.empty()) return matches;
  // Enhanced costs are centred at 0 up to rounding; costs that are not enhanced are centred here.
  const double sum = std::accumulate(enhanced.values.begin(), enhanced.values.end(), 0.0);
  const auto centre = static_cast<float>(sum / static_cast<double>(enhanced.values.size()));

  constexpr std::size_t kBand = 16;  // queries that share one set of buffers
  vo::parallel_for((enhanced.queries + kBand - 1) / kBand, [&](std::size_t band) {
    QuerySearch search(enhanced, lines, options, centre);
    for (std::size_t q = band * kBand; q < std::min(enhanced.queries, (band + 1) * kBand); ++q)
      matches[q] = search(q);
  });
  return matches;
}

}  // namespace place
