#include "kept_matrices.hpp"

#include <algorithm>
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

MatrixKeeper::MatrixKeeper(const place::Route& route, bool whole) : route_(route), whole_(whole) {}

void MatrixKeeper::operator()(const place::SearchPart& part) {
  while (matrices_.size() <= part.traverse) {
    const place::Traverse& traverse = route_.traverses[matrices_.size()];
    matrices_.push_back(empty_matrix(part.costs.queries, traverse.keyframes.size(), whole_));
  }
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

}  // namespace retrace
