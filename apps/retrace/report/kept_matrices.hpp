#pragma once

#include <cstddef>
#include <vector>

#include <place/match/route_matching.hpp>
#include <place/match/team.hpp>

namespace retrace {

/// The matrices of a search against one traverse, for people to look at.
struct KeptMatrix {
  place::CostMatrix cost;
  place::CostMatrix enhanced;
  std::size_t shrink = 1;  ///< in a large matrix, a cell is the least of this many by this many costs;
                           ///< infinite if no pair of them was compared
};

/// Keeps the matrices of a search as they arrive (`place::SearchCallback`): at most 1024 cells along a side,
/// unless whole ones are requested. Memory: 8 MB for each traverse.
class MatrixKeeper {
 public:
  MatrixKeeper(const place::Route& route, bool whole);
  /// Of traverses whose keyframes come with their parts.
  explicit MatrixKeeper(bool whole);

  void operator()(const place::SearchPart& part);
  void take(const place::SearchPart& part, std::size_t keyframes);

  /// Gives the first member of a team the parts that all of them took.
  void join(place::Team& team);

  /// One for each traverse that was searched.
  [[nodiscard]] const std::vector<KeptMatrix>& matrices() const { return matrices_; }

 private:
  const place::Route* route_ = nullptr;
  bool whole_;
  std::vector<KeptMatrix> matrices_;
};

}  // namespace retrace
