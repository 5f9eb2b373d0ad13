#include "trajectory/selected_inverse.hpp"

#include <stdexcept>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse lower_of(const Eigen::MatrixXd& dense) {
  return Eigen::MatrixXd(dense.triangularView<Eigen::Lower>()).sparseView();
}

TEST(SelectedInverse, OfTwoByTwoByHand) {
  Eigen::Matrix2d matrix;
  matrix << 2, 1, 1, 3;  // determinant 5, inverse [3 -1; -1 2] / 5
  const place::SelectedInverse inverse(lower_of(matrix));
  EXPECT_DOUBLE_EQ(inverse.at(0, 0), 0.6);
  EXPECT_DOUBLE_EQ(inverse.at(1, 0), -0.2);
  EXPECT_DOUBLE_EQ(inverse.at(0, 1), -0.2);
  EXPECT_DOUBLE_EQ(inverse.at(1, 1), 0.4);
}

TEST(SelectedInverse, EqualsTheDenseInverseWhereTheMatrixHasEntries) {
  // A chain of blocks of three with a few ties across, as loops make them.
  constexpr int kSize = 60;
  vo::Rng rng(1);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(kSize, kSize);
  const auto tie = [&](int a, int b) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(kSize);
    for (int i = 0; i < 3; ++i) {
      row[a + i] = rng.normal();
      row[b + i] = rng.normal();
    }
    matrix += row * row.transpose();
  };
  for (int a = 0; a + 3 < kSize; a += 3)
    for (int times = 0; times < 4; ++times) tie(a, a + 3);
  tie(6, 45);
  tie(0, 57);
  matrix += 0.1 * Eigen::MatrixXd::Identity(kSize, kSize);
  const Eigen::MatrixXd dense = matrix.inverse();
  const place::SelectedInverse inverse(lower_of(matrix));
  for (int r = 0; r < kSize; ++r) {
    for (int c = 0; c < kSize; ++c) {
      if (matrix(r, c) == 0) continue;
      EXPECT_NEAR(inverse.at(r, c), dense(r, c), 1e-9 * dense.cwiseAbs().maxCoeff()) << r << ' ' << c;
    }
  }
  EXPECT_THROW(static_cast<void>(inverse.at(0, 30)), std::out_of_range);  // far apart on the chain
}

TEST(SelectedInverse, OfADiagonalAndOfNothing) {
  const place::SelectedInverse inverse(lower_of(Eigen::Vector3d(1, 2, 4).asDiagonal().toDenseMatrix()));
  EXPECT_DOUBLE_EQ(inverse.at(2, 2), 0.25);
  EXPECT_THROW(static_cast<void>(inverse.at(2, 0)), std::out_of_range);
  EXPECT_NO_THROW(place::SelectedInverse(Sparse(0, 0)));
}

TEST(SelectedInverse, RefusesWhatIsNotPositiveDefinite) {
  EXPECT_THROW(place::SelectedInverse(lower_of(Eigen::Vector2d(1, -1).asDiagonal().toDenseMatrix())),
               std::invalid_argument);
  EXPECT_THROW(place::SelectedInverse(lower_of(Eigen::Vector2d(1, 0).asDiagonal().toDenseMatrix())),
               std::invalid_argument);
}

}  // namespace
