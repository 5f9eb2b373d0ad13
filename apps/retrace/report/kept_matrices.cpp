#include "kept_matrices.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

constexpr std::size_t kLargest = 1024;  // cells along a side

std::size_t parts(std::size_t count, std::size_t of) {
  return (count + of - 1) / of;
}

KeptMatrix empty_matrix(std::size_t queries, std::size_t references, bool whole) {
  KeptMatrix kept;
  if (!whole) kept.shrink = std::max<std::size_t>(1, parts(std::max(queries, references), kLargest));
  for (place::CostMatrix* matrix : {&kept.cost, &kept.enhanced}) {
    *matrix = place::make_cost_matrix(parts(queries, kept.shrink), parts(references, kept.shrink));
    std::ranges::fill(matrix->values, std::numeric_limits<float>::infinity());
  }
  return kept;
}

}  // namespace

MatrixKeeper::MatrixKeeper(const place::Route& route, bool whole) : route_(&route), whole_(whole) {}
MatrixKeeper::MatrixKeeper(bool whole) : whole_(whole) {}

void MatrixKeeper::operator()(const place::SearchPart& part) {
  take(part, route_->traverses[part.traverse].keyframes.size());
}

void MatrixKeeper::take(const place::SearchPart& part, std::size_t keyframes) {
  if (matrices_.size() <= part.traverse) matrices_.resize(part.traverse + 1);
  if (matrices_[part.traverse].cost.values.empty())
    matrices_[part.traverse] = empty_matrix(part.costs.queries, keyframes, whole_);
  KeptMatrix& kept = matrices_[part.traverse];
  place::CostMatrix& matrix = part.enhanced ? kept.enhanced : kept.cost;
  vo::parallel_for(matrix.queries, [&](std::size_t cell_row) {
    const std::span<float> cells = matrix.row(cell_row);
    const std::size_t end = std::min(part.costs.queries, (cell_row + 1) * kept.shrink);
    for (std::size_t q = cell_row * kept.shrink; q < end; ++q) {
      const std::span<const float> row = part.costs.row(q);
      const std::size_t* reference = part.references.data() + part.costs.first_reference;
      for (std::size_t i = 0; i < row.size();) {
        const std::size_t cell = reference[i] / kept.shrink;
        float least = cells[cell];
        for (; i < row.size() && reference[i] / kept.shrink == cell; ++i) least = std::min(least, row[i]);
        cells[cell] = least;
      }
    }
  });
}

void MatrixKeeper::join(place::Team& team) {
  std::vector<float> mine;  // of all traverses, one after the other: those of each member have one size
  for (const KeptMatrix& kept : matrices_)
    for (const place::CostMatrix* const matrix : {&kept.cost, &kept.enhanced})
      mine.insert(mine.end(), matrix->values.begin(), matrix->values.end());
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(mine.data());
  for (const place::Team::Message& other : team.collect({bytes, mine.size() * sizeof(float)})) {
    std::size_t at = 0;
    for (KeptMatrix& kept : matrices_) {
      for (place::CostMatrix* const matrix : {&kept.cost, &kept.enhanced}) {
        for (float& cell : matrix->values) {
          float value = 0;
          std::memcpy(&value, other.data() + sizeof value * at++, sizeof value);
          cell = std::min(cell, value);
        }
      }
    }
  }
}

}  // namespace retrace
