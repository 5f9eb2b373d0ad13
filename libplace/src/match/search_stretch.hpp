#pragma once

#include "kernels/line_sums.hpp"
#include "match/line_runs.hpp"
#include "place/match/sequence_searcher.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// `SequenceSearcher` works on one stretch of the reference at a time.
namespace place {

inline constexpr float kUnreached = std::numeric_limits<float>::infinity();
inline constexpr std::size_t kChunk = kernels::kChunk;

constexpr std::size_t chunks_of(std::size_t count) {
  return (count + kChunk - 1) / kChunk;
}

/// What all stretches of the reference share.
struct SearchPlan {
  SearchPlan(std::size_t query_count, std::size_t reference_count, const CostRange& range,
             const SequenceSearchOptions& settings);

  /// Terms [first, last) of a line lie inside the matrix's queries.
  [[nodiscard]] int first_term(std::size_t query) const {
    return std::max(0, options.length / 2 - clamped(query));
  }
  [[nodiscard]] int last_term(std::size_t query) const {
    return std::min(options.length, clamped(queries - query) + options.length / 2);
  }
  /// How many of these lie inside the reference too.
  [[nodiscard]] int terms_inside(const SearchLine& line, std::size_t query, std::size_t reference) const;
  /// The factor from an integer sum of that many terms to a cost.
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
  float cost = kUnreached;
  std::size_t line = 0;
};

/// A stretch of the reference: running sums along each step for the last rows, and the search on them.
class SearchStretch {
 public:
  /// References [begin, begin + width) of those of `plan`, which is kept by reference.
  SearchStretch(const SearchPlan& plan, std::size_t begin, std::size_t width);

  /// Adds a row of the matrix, from reference `first` on, with everything that lines reach; or, past the last
  /// query, a row without costs.
  void add_row(std::size_t query, std::size_t first, std::span<const float> costs);

  /// Finds the best lines of a query whose rows have all been added. `costs` and `chunk_least`: of the
  /// stretch's references, a multiple of kChunk, and of its chunks.
  StretchBest search(std::size_t query, float* costs, float* chunk_least);

  [[nodiscard]] std::size_t begin() const { return begin_; }

 private:
  static constexpr std::size_t kLead = 4;  // columns of 0 for a running sum to begin from; the largest step

  /// A chunk some of whose lines leave the reference.
  struct Edge {
    std::size_t chunk;
    std::vector<float> factors, terms;  ///< see `LineKernels::least_weighted`
  };

  [[nodiscard]] std::uint32_t* row(std::size_t ring, std::size_t slot) {
    return sums_.data() + (ring * depth_ + slot) * columns_;
  }

  [[nodiscard]] bool is_edge(std::size_t chunk) const;

  void weigh_edges(std::size_t query);

  /// Sets `run_ends_` to where the running sums of each run end and begin for a query, at the first
  /// reference.
  void point_to_rows(std::size_t query);

  /// The first line with the least cost.
  [[nodiscard]] std::size_t line_of(const StretchBest& best, float factor) const;

  const SearchPlan& plan_;
  const kernels::LineKernels& kernels_ = kernels::line_kernels();
  std::size_t begin_, width_;
  std::size_t before_;   ///< columns left of the first reference
  std::size_t columns_;  ///< in a row
  std::size_t depth_;    ///< rows kept
  std::vector<std::uint32_t> sums_;
  std::vector<kernels::RunEnds> run_ends_;
  std::vector<Edge> edges_;
  const Edge* best_edge_ = nullptr;
  bool weights_are_whole_ = false;
};

/// The number of references in a stretch: its running sums fit the second-level cache.
std::size_t stretch_width(const SearchRuns& runs);

}  // namespace place
