#include "place/describe/row_products.hpp"

#include "kernels/float_sums.hpp"
#include "kernels/interleave.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr std::size_t kStretch = 1024;  // values added up before their sum is added: they stay in the cache
constexpr std::size_t kTiles = 8;       // of rows on the left, for each reading of the panels

using Interleave = void (*)(const FloatRowsView&, const kernels::RowBlock&, std::size_t, float*);

/// One side of a product: the rows or the columns of a matrix.
struct Side {
  FloatRowsView matrix;
  bool columns;

  [[nodiscard]] std::size_t count() const { return columns ? matrix.width : matrix.size(); }
  [[nodiscard]] std::size_t width() const { return columns ? matrix.size() : matrix.width; }
  [[nodiscard]] Interleave interleave() const {
    return columns ? kernels::interleave_columns : kernels::interleave;
  }
};

constexpr std::size_t parts(std::size_t count, std::size_t size) {
  return (count + size - 1) / size;
}

FloatRows panels_of(const Side& side) {
  const std::size_t lanes = kernels::float_kernels().references, count = side.count();
  FloatRows panels = make_float_rows(lanes * side.width(), parts(count, lanes));
  vo::parallel_for(panels.size(), [&](std::size_t panel) {
    const std::size_t first = panel * lanes;
    side.interleave()(side.matrix, {first, std::min(lanes, count - first), 0, side.width()}, lanes,
                      panels[panel].data());
  });
  return panels;
}

/// Adds to row `i` of `out`, beginning with column `first`, the first `count` sums of row `i` of a tile.
void add_sums(const std::vector<float>& sums, std::size_t stride, std::size_t rows, std::size_t first_row,
              std::size_t first, std::size_t count, FloatRows& out) {
  for (std::size_t i = 0; i < rows; ++i) {
    float* const to = out[first_row + i].data() + first;
    for (std::size_t j = 0; j < count; ++j) to[j] += sums[i * stride + j];
  }
}

/// The products of all rows of `left` with all of `right_count` rows in panels; with `lower` only of those up
/// to its own number.
FloatRows multiply(const Side& left, const FloatRows& panels, std::size_t right_count, bool lower) {
  const kernels::FloatKernels& kernel = kernels::float_kernels();
  const std::size_t tall = kernel.queries, wide = kernel.references, width = left.width();
  FloatRows out = make_float_rows(right_count, left.count());
  const std::size_t together = kTiles * tall;
  vo::parallel_for(parts(left.count(), together), [&](std::size_t group) {
    const std::size_t begin = group * together, end = std::min(begin + together, left.count());
    std::vector<float> tiles(together * std::min(kStretch, width)), sums(tall * wide);
    for (std::size_t from = 0; from < width; from += kStretch) {
      const std::size_t values = std::min(kStretch, width - from);
      for (std::size_t row = begin; row < end; row += tall)
        left.interleave()(left.matrix, {row, std::min(tall, end - row), from, values}, tall,
                          tiles.data() + (row - begin) * values);
      for (std::size_t first = 0; first < (lower ? end : right_count); first += wide) {
        const float* const panel = panels[first / wide].data() + from * wide;
        for (std::size_t row = begin; row < end; row += tall) {
          kernel.add(kernels::Term::kProduct,
                     {tiles.data() + (row - begin) * values, panel, values, sums.data()});
          add_sums(sums, wide, std::min(tall, end - row), row, first, std::min(wide, right_count - first),
                   out);
        }
      }
    }
  });
  return out;
}

FloatRows products_of_pairs(const Side& side) {
  FloatRows out = multiply(side, panels_of(side), side.count(), true);
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t j = i + 1; j < out.size(); ++j) out[i][j] = out[j][i];
  return out;
}

}  // namespace

RowPanels::RowPanels(const FloatRows& rows)
    : count_(rows.size()), width_(rows.width), panels_(panels_of({rows, false})) {}

RowPanels RowPanels::of_columns(const FloatRows& matrix) {
  RowPanels panels;
  panels.count_ = matrix.width;
  panels.width_ = matrix.size();
  panels.panels_ = panels_of({matrix, true});
  return panels;
}

FloatRows RowPanels::products(const FloatRows& left) const {
  if (left.width != width_)
    throw std::invalid_argument("RowPanels::products: rows of the same length expected");
  return multiply({left, false}, panels_, count_, false);
}

FloatRows products_of_rows(const FloatRows& rows) {
  return products_of_pairs({rows, false});
}

FloatRows products_of_columns(const FloatRows& matrix) {
  return products_of_pairs({matrix, true});
}

}  // namespace place
