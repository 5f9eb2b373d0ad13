#include "place/describe/principal_axes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

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

/// An orthonormal basis of what the columns span.
Eigen::MatrixXf basis_of(const Eigen::MatrixXf& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> qr(columns);
  return qr.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

/// The products of blocks of rows, in parallel.
void for_row_blocks(Eigen::Index rows, const std::function<void(Eigen::Index, Eigen::Index)>& body) {
  constexpr Eigen::Index kBlock = 256;
  vo::parallel_for(static_cast<std::size_t>((rows + kBlock - 1) / kBlock), [&](std::size_t block) {
    const Eigen::Index first = static_cast<Eigen::Index>(block) * kBlock;
    body(first, std::min(kBlock, rows - first));
  });
}

}  // namespace

PrincipalAxes principal_axes(const FloatRows& vectors, std::size_t count) {
  if (vectors.size() == 0 || count == 0)
    throw std::invalid_argument("principal_axes: vectors and a count of at least 1 expected");
  const ConstRows all = matrix_of(vectors);
  const Eigen::RowVectorXf mean = all.colwise().mean();
  const Rows centred = all.rowwise() - mean;
  const Eigen::Index width = all.cols(),
                     wanted = std::min({static_cast<Eigen::Index>(count), width, all.rows()});
  // Some more than wanted: what makes few iterations enough (section 4.5 there).
  const Eigen::Index tried = std::min({wanted + 16, width, all.rows()});
  constexpr int kIterations = 3;
  vo::Rng rng(1);
  Eigen::MatrixXf basis(width, tried);
  for (float& value : basis.reshaped()) value = static_cast<float>(rng.normal());
  Rows along(all.rows(), tried);
  const auto project_on_basis = [&] {
    for_row_blocks(all.rows(), [&](Eigen::Index first, Eigen::Index rows) {
      along.middleRows(first, rows).noalias() = centred.middleRows(first, rows) * basis;
    });
  };
  for (int i = 0; i < kIterations; ++i) {
    basis = basis_of(basis);
    project_on_basis();
    for_row_blocks(width, [&](Eigen::Index first, Eigen::Index rows) {
      basis.middleRows(first, rows).noalias() = centred.middleCols(first, rows).transpose() * along;
    });
  }
  basis = basis_of(basis);
  project_on_basis();
  const Eigen::MatrixXf covariance = along.transpose() * along;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> solver(covariance);

  PrincipalAxes result{.mean = {mean.begin(), mean.end()}, .axes = {.width = vectors.width, .values = {}}};
  const float largest = solver.eigenvalues().size() > 0 ? solver.eigenvalues().tail(1)(0) : 0;
  constexpr float kRounding = 1e-6F;  // of the largest variance; below is rounding
  for (Eigen::Index i = 0; i < wanted; ++i) {
    const Eigen::Index column = tried - 1 - i;
    if (!(solver.eigenvalues()(column) > kRounding * largest)) break;
    Eigen::VectorXf axis = (basis * solver.eigenvectors().col(column)).normalized();
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
