#pragma once

#include <Eigen/SparseCore>

namespace place {

/// Entries of the inverse of a sparse symmetric positive definite matrix, where its Cholesky factor has
/// entries, which is wherever the matrix itself has. Takahashi, Fagan and Chen, "Formation of a sparse bus
/// impedance matrix", 1973: the inverse Z of L D L' obeys Z = D^-1 L^-1 + (I - L') Z, so each of these
/// entries follows from those below and to the right of it. O(sum of squared column counts of L), linear for
/// a chain.
class SelectedInverse {
 public:
  /// `lower`: the lower triangle. Throws `std::invalid_argument` if the matrix is not positive definite.
  explicit SelectedInverse(const Eigen::SparseMatrix<double>& lower);

  /// An entry. Throws `std::out_of_range` where the factor has none.
  [[nodiscard]] double at(Eigen::Index row, Eigen::Index column) const;

 private:
  Eigen::SparseMatrix<double> inverse_;  // lower triangle, in the factor's order and pattern
  Eigen::VectorXi order_;                // for each index, its place in that order
};

}  // namespace place
