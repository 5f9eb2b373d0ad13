#pragma once

#include "kernels/path_rows.hpp"
#include "match/tree_sum.hpp"
#include "place/match/search_lines.hpp"
#include "place/match/search_path.hpp"
#include "place/match/team.hpp"
#include "place/match/walk_gaps.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// The transitions and likelihoods of `search_path`, applied to one row at a time. A row's overall factor
/// does not matter, so each row carries one. A member of a team has a shard of every row, and with each step
/// gets the values beside it from its neighbours.
class PathModel {
 public:
  /// Both options must be valid. `count`: references of the whole; `own`: this member's. Rows have values
  /// `beside` references beyond it.
  PathModel(const PathSearchOptions& options, const SequenceSearchOptions& sequence,
            std::vector<Stretch> references, std::size_t count, Shard own, std::size_t beside, Team& team);

  /// A row of the posterior's factors: on the route, and off it.
  struct Row {
    std::vector<float> on;  ///< at references first(), first() + 1, ...
    double off = 0;
    double scale = 1;  ///< multiplies both
  };
  [[nodiscard]] std::size_t first() const { return first_; }
  [[nodiscard]] std::size_t width() const { return last_ - first_; }

  /// How much more probable each pair of a query is on the route than off it.
  void likelihoods(std::span<const float> costs, std::span<float> out) const;

  /// The first query's prior. `likelihoods` here and below: of the shard's own references.
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
  /// Sums over a row, and over the ends of stretches.
  struct Sums {
    double row = 0, ends = 0;
  };
  /// Multiplies own references by the likelihoods into `out`, and gets the neighbours' values beside them.
  /// `ends`: one value for each stretch that ends here, in order.
  Sums multiply(const std::vector<float>& row, std::span<const float> likelihoods, std::vector<float>& out,
                std::span<const double> ends) const;
  Sums share(std::vector<float>& row, const TreeSum<double>& sum, std::span<const double> ends) const;

  const kernels::PathKernels& kernels_ = kernels::path_kernels();
  std::vector<Stretch> references_;
  std::size_t count_;
  Shard own_;
  std::size_t beside_, halo_ = 0;  // references beside the shard: that are wanted, and that steps need too
  std::size_t first_ = 0, last_ = 0;
  Team& team_;
  std::vector<Steps> steps_;  // for each query, or one for all
  double leave_;              // probability of leaving the route, and of returning, at a query
};

}  // namespace place
