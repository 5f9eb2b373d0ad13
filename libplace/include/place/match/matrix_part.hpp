#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/team.hpp"

#include <cstddef>
#include <span>

namespace place {

/// A member's part of a matrix: all queries by the references of its shard and some beside it.
struct MatrixPart {
  CostView costs;  ///< all queries by references first, first + 1, ...
  std::size_t first = 0;
  Shard own;                   ///< references [own.begin, own.end) are this member's
  std::size_t references = 0;  ///< of the whole

  [[nodiscard]] std::size_t queries() const { return costs.queries; }
  /// A query's own costs.
  [[nodiscard]] std::span<const float> own_row(std::size_t query) const {
    return costs.row(query).subspan(own.begin - first, own.size());
  }
  [[nodiscard]] bool has(std::size_t reference) const {
    return own.begin <= reference && reference < own.end;
  }
};

/// The whole of a matrix as the part of a team of one.
inline MatrixPart whole_of(const CostView& costs) {
  return {costs, 0, {0, costs.references}, costs.references};
}

}  // namespace place
