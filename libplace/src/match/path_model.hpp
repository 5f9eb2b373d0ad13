#pragma once

#include "match/kernels/path_rows.hpp"
#include "place/match/search_lines.hpp"
#include "place/match/search_path.hpp"
#include "place/match/walk_gaps.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// The transitions and likelihoods of `search_path`, applied to one row at a time. A row has `references`
/// values; its overall factor does not matter, so each row carries one.
class PathModel {
 public:
  /// Both options must be valid.
  PathModel(const PathSearchOptions& options, const SequenceSearchOptions& sequence,
            std::vector<Stretch> references, std::size_t count);

  /// A row of the posterior's factors: on the route, and off it.
  struct Row {
    std::vector<float> on;
    double off = 0;
    double scale = 1;  ///< multiplies both
  };

  /// How much more probable each pair of a query is on the route than off it.
  void likelihoods(std::span<const float> costs, std::span<float> out) const;

  /// The first query's prior.
  void begin(std::span<const float> likelihoods, Row& row) const;
  /// From a query's row to the next query's.
  void forward(std::size_t query, const Row& before, std::span<const float> likelihoods, Row& row) const;
  /// From a query's row to the previous query's; `work` holds a row.
  void backward(std::size_t query, const Row& after, std::span<const float> likelihoods, Row& row,
                std::vector<float>& work) const;

 private:
  /// p(s) for s = first, first + 1, ...
  struct Steps {
    std::size_t first = 0;
    std::vector<float> probability;
  };
  [[nodiscard]] const Steps& steps_to(std::size_t query) const {
    return steps_.size() == 1 ? steps_.front() : steps_[query];
  }

  const kernels::PathKernels& kernels_ = kernels::path_kernels();
  std::vector<Stretch> references_;
  std::size_t count_;
  std::vector<Steps> steps_;  // for each query, or one for all
  double leave_;              // probability of leaving the route, and of returning, at a query
};

}  // namespace place
