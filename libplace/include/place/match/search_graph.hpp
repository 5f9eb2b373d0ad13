#pragma once

#include <string>

namespace place {

struct CostView;
struct SearchOptions;
struct SearchResult;

/// Settings of `search_graph`.
struct GraphSearchOptions {
  int fan_out = 5;  ///< references beyond a node's at which the next query may be (the paper's K)
  /// Deviations of the enhanced cost: a pair that costs more is a hidden node, a picture that matches nothing
  /// (the paper's non-matching cost). At one below the mean, a sixth of all pairs are as alike by chance.
  double hidden_cost = -1;
  /// A path that lags behind is expanded while its cost, plus this share of the mean cost for each query it
  /// lags, is below the best path's. 0 finds the cheapest path of all; 1 looks at the fewest cells.
  double expansion_rate = 0.7;

  /// False, with a reason that names field, value and constraint, if a field is out of its range.
  bool is_valid(std::string* reason) const;
};

/// Lazy graph search (Vysotska and Stachniss 2016, "Lazy data association for image sequences matching under
/// substantial appearance changes"; SSS 7 names it as an alternative): one path through the whole walk, the
/// cheapest chain of (query, reference) nodes in which the reference advances by 0 to `fan_out` with every
/// query. The paper also lets it go back, but then a walk played backwards is found as well, and no match is
/// known to be wrong (`decoy_scores`). Nodes are expanded in the order of their path's cost, and only while
/// they can still compete with the best, so most cells are never looked at.
///
/// A node costs 1 / z (the paper's edge weight), with likeness z = exp(-cost), but at most a hidden node's,
/// exp(hidden_cost). Where the last five nodes are all hidden, the walk counts as lost, as at its
/// beginning, and is searched for in the whole row (as in the authors' later work, 2017): every reference
/// that is not a hidden node is then a start. The search restarts at gaps of the query and does not cross
/// those of the reference.
///
/// A hidden node stays unmatched. The score of a match is how far the path around it lies below hidden_cost:
/// the sum over the sequence of hidden_cost - cost, hidden nodes 0, over sqrt(terms * length), in deviations.
/// One thread, as the order of expansion is the method. O(n log n) for n nodes reached, under 100 bytes for
/// each. Throws `std::invalid_argument` for options that are not valid.
SearchResult search_graph(const CostView& enhanced, const SearchOptions& options);

}  // namespace place
