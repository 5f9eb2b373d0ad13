#include "trajectory/selected_inverse.hpp"

#include <algorithm>
#include <stdexcept>

#include <Eigen/SparseCholesky>

namespace place {
namespace {

/// The value at (row, column) of the lower triangle; null where there is none.
const double* entry(const Eigen::SparseMatrix<double>& lower, int row, int column) {
  const int* begin = lower.innerIndexPtr() + lower.outerIndexPtr()[column];
  const int* end = lower.innerIndexPtr() + lower.outerIndexPtr()[column + 1];
  const int* found = std::lower_bound(begin, end, row);
  return found == end || *found != row ? nullptr : lower.valuePtr() + (found - lower.innerIndexPtr());
}

}  // namespace

SelectedInverse::SelectedInverse(const Eigen::SparseMatrix<double>& lower) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky(lower);
  if (cholesky.info() != Eigen::Success || !(cholesky.vectorD().array() > 0).all())
    throw std::invalid_argument("SelectedInverse: a positive definite matrix expected");
  order_ = cholesky.permutationP().indices();
  // L has no diagonal there; ones make room for Z's diagonal.
  Eigen::SparseMatrix<double> identity(lower.rows(), lower.cols());
  identity.setIdentity();
  const Eigen::SparseMatrix<double> factor = cholesky.matrixL().nestedExpression();
  inverse_ = factor.triangularView<Eigen::StrictlyLower>();
  inverse_ += identity;
  const Eigen::SparseMatrix<double> l = inverse_;
  const Eigen::VectorXd d = cholesky.vectorD();

  // Columns from the last, and rows from the bottom in each: Z_ij = [i = j] / d_j - sum over k > j of L_kj
  // Z_ki.
  for (int j = static_cast<int>(l.cols()) - 1; j >= 0; --j) {
    const int first = l.outerIndexPtr()[j], end = l.outerIndexPtr()[j + 1];
    for (int at = end - 1; at >= first; --at) {
      const int i = l.innerIndexPtr()[at];
      double value = i == j ? 1 / d[j] : 0;
      for (int below = first + 1; below < end; ++below) {
        const int k = l.innerIndexPtr()[below];
        // Rows in one column of L are connected to each other, so Z has the entry.
        value -= l.valuePtr()[below] * *entry(inverse_, std::max(i, k), std::min(i, k));
      }
      inverse_.valuePtr()[at] = value;
    }
  }
}

double SelectedInverse::at(Eigen::Index row, Eigen::Index column) const {
  const int r = order_[row], c = order_[column];
  const double* value = entry(inverse_, std::max(r, c), std::min(r, c));
  if (value == nullptr) throw std::out_of_range("SelectedInverse: the factor has no such entry");
  return *value;
}

}  // namespace place
