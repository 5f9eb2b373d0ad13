#include "place/describe/principal_axes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace place {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using ConstRows = Eigen::Map<const Rows>;

ConstRows matrix_of(const FloatRows& rows) {
  return {rows.values.data(), static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.width)};
}

/// The products of blocks of rows, in parallel.
void for_row_blocks(Eigen::Index rows, const std::function<void(Eigen::Index, Eigen::Index)>& body) {
  constexpr Eigen::Index kBlock = 256;
  vo::parallel_for(static_cast<std::size_t>((rows + kBlock - 1) / kBlock), [&](std::size_t block) {
    const Eigen::Index first = static_cast<Eigen::Index>(block) * kBlock;
    body(first, std::min(kBlock, rows - first));
  });
}

/// Products of all columns of a matrix with each other, or of all rows, in parallel by tiles.
Eigen::MatrixXf products_of_pairs(const Rows& matrix, bool by_columns) {
  constexpr Eigen::Index kTile = 128;
  const Eigen::Index size = by_columns ? matrix.cols() : matrix.rows();
  std::vector<std::pair<Eigen::Index, Eigen::Index>> tiles;  // of the lower triangle
  for (Eigen::Index i = 0; i < size; i += kTile)
    for (Eigen::Index j = 0; j <= i; j += kTile) tiles.emplace_back(i, j);
  Eigen::MatrixXf products(size, size);
  vo::parallel_for(tiles.size(), [&](std::size_t tile) {
    const auto [i, j] = tiles[tile];
    const Eigen::Index down = std::min(kTile, size - i), across = std::min(kTile, size - j);
    if (by_columns) {
      products.block(i, j, down, across).noalias() =
          matrix.middleCols(i, down).transpose() * matrix.middleCols(j, across);
    } else {
      products.block(i, j, down, across).noalias() =
          matrix.middleRows(i, down) * matrix.middleRows(j, across).transpose();
    }
  });
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
  return products;
}

/// The eigenvectors of a symmetric matrix's largest eigenvalues, largest first.
struct Leading {
  Eigen::MatrixXf vectors;
  Eigen::VectorXf values;
};

Leading leading_vectors(const Eigen::MatrixXf& symmetric, Eigen::Index wanted) {
  const Eigen::Index size = symmetric.rows();
  // A few more than wanted, so that few iterations are enough (section 4.5 there).
  const Eigen::Index tried = std::min(wanted + 16, size);
  Eigen::MatrixXf basis = Eigen::MatrixXf::Identity(size, size);
  if (tried < size) {
    constexpr int kIterations = 4;
    vo::Rng rng(1);
    basis.resize(size, tried);
    for (float& value : basis.reshaped()) value = static_cast<float>(rng.normal());
    for (int i = 0; i < kIterations; ++i) {
      const Eigen::HouseholderQR<Eigen::MatrixXf> qr(symmetric * basis);
      basis = qr.householderQ() * Eigen::MatrixXf::Identity(size, tried);
    }
  }
  const Eigen::MatrixXf within = basis.transpose() * (symmetric * basis);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> solver(within);
  const Eigen::MatrixXf vectors = basis * solver.eigenvectors().rightCols(wanted);
  return {.vectors = vectors.rowwise().reverse(), .values = solver.eigenvalues().tail(wanted).reverse()};
}

}  // namespace

PrincipalAxes principal_axes(const FloatRows& vectors, std::size_t count) {
  if (vectors.size() == 0 || count == 0)
    throw std::invalid_argument("principal_axes: vectors and a count of at least 1 expected");
  const ConstRows all = matrix_of(vectors);
  const Eigen::RowVectorXf mean = all.colwise().mean();
  const Rows centred = all.rowwise() - mean;
  PrincipalAxes result{.mean = {mean.begin(), mean.end()}, .axes = {.width = vectors.width, .values = {}}};

  // The products of all pairs of columns or of all pairs of rows, whichever are fewer: their leading vectors
  // are the axes, or the weights of the vectors that sum to them.
  const bool by_columns = all.cols() <= all.rows();
  const auto wanted = std::min(static_cast<Eigen::Index>(count), std::min(all.cols(), all.rows()));
  const Leading leading = leading_vectors(products_of_pairs(centred, by_columns), wanted);
  Eigen::MatrixXf axes = leading.vectors;
  if (!by_columns) {
    axes.resize(all.cols(), wanted);
    for_row_blocks(all.cols(), [&](Eigen::Index first, Eigen::Index rows) {
      axes.middleRows(first, rows).noalias() = centred.middleCols(first, rows).transpose() * leading.vectors;
    });
  }
  const float largest = leading.values(0);
  constexpr float kRounding = 1e-6F;  // of the largest variance; anything below is rounding
  for (Eigen::Index i = 0; i < wanted; ++i) {
    if (!(leading.values(i) > kRounding * largest)) break;
    Eigen::VectorXf axis = axes.col(i).normalized();
    Eigen::Index peak = 0;
    axis.cwiseAbs().maxCoeff(&peak);
    if (axis(peak) < 0) axis = -axis;
    result.axes.values.insert(result.axes.values.end(), axis.begin(), axis.end());
  }
  return result;
}

FloatRows project(const FloatRows& vectors, const PrincipalAxes& axes) {
  FloatRows out = make_float_rows(axes.axes.size(), vectors.size());
  if (out.values.empty()) return out;
  const ConstRows all = matrix_of(vectors), along = matrix_of(axes.axes);
  Eigen::RowVectorXf offset = Eigen::RowVectorXf::Zero(along.rows());
  if (!axes.mean.empty()) {
    offset = Eigen::Map<const Eigen::RowVectorXf>(axes.mean.data(), all.cols()) * along.transpose();
  }
  Eigen::Map<Rows> result(out.values.data(), all.rows(), along.rows());
  for_row_blocks(all.rows(), [&](Eigen::Index first, Eigen::Index rows) {
    result.middleRows(first, rows).noalias() = all.middleRows(first, rows) * along.transpose();
    result.middleRows(first, rows).rowwise() -= offset;
  });
  return out;
}

}  // namespace place
