#pragma once

#include <string>

namespace place {

struct CostMatrix;
struct SearchOptions;
struct SearchResult;

/// Settings of `search_graph`.
struct GraphSearchOptions {
  int fan_out = 5;  ///< references past a node's that the next query may be at (the paper's K)
  /// Deviations of the enhanced cost: a dearer pair is passed as a hidden node, a picture that matches
  /// nothing (the paper's non-matching cost). One under the mean: a sixth of all pairs are as alike by
  /// chance.
  double hidden_cost = -1;
  /// What a path that lags behind must promise to be followed: its cost and this share of the mean cost for
  /// each query it lags, against the best path's. 0 finds the cheapest path of all, 1 looks at least.
  double expansion_rate = 0.7;

  /// False, with a reason that names field, value and constraint, if a field is out of its range.
  bool is_valid(std::string* reason) const;
};

/// Lazy graph search (Vysotska and Stachniss 2016, "Lazy data association for image sequences matching under
/// substantial appearance changes"; SSS 7 names it as an alternative): one path through the whole walk, the
/// cheapest chain of (query, reference) nodes in which the reference goes on by 0 to `fan_out` with every
/// query; the paper also lets it go back, but then a walk played backwards is found as well and no match is
/// known to be wrong (`decoy_scores`). Nodes are expanded in the order of their path's cost, and only while
/// they can still compete with the best, so most cells are never looked at.
///
/// A node costs 1 / z (the paper's edge weight), z = exp(-cost) the likeness, but no more than a hidden node,
/// exp(hidden_cost). Where four fifths of the last five nodes are hidden the walk counts as lost, as where it
/// begins, and is looked for in the whole row (as in the authors' later work, 2017): every reference that is
/// no hidden node there is then a start. Gaps of the query begin anew, those of the reference are not
/// crossed.
///
/// A hidden node stays unmatched. The score of a match is how far below hidden_cost the path runs around it:
/// the sum over the sequence of hidden_cost - cost, hidden nodes 0, over sqrt(terms * length), in deviations.
/// One thread: the order of expansion is the method. O(n log n) for n nodes reached, 24 bytes or so for each.
/// Throws `std::invalid_argument` for options that are not valid.
SearchResult search_graph(const CostMatrix& enhanced, const SearchOptions& options);

}  // namespace place
