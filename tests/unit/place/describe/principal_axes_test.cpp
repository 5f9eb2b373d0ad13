#include "place/describe/principal_axes.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::FloatRows;
using place::make_float_rows;
using place::principal_axes;
using place::PrincipalAxes;

/// Vectors about a mean of 3 whose k-th value has deviation 1 / (k + 1), mixed by nothing.
FloatRows decaying(std::size_t width, std::size_t count, std::uint64_t seed) {
  vo::Rng rng(seed);
  FloatRows rows = make_float_rows(width, count);
  for (std::size_t i = 0; i < rows.values.size(); ++i)
    rows.values[i] = static_cast<float>(3 + rng.normal() / static_cast<double>(i % width + 1));
  return rows;
}

double dot(std::span<const float> a, std::span<const float> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

TEST(PrincipalAxes, OfPointsOnALineIsItsDirection) {
  const FloatRows line{.width = 2, .values = {1, 1, 4, 5, 7, 9}};  // along (3, 4), about (4, 5)
  const PrincipalAxes axes = principal_axes(line, 2);
  EXPECT_THAT(axes.mean, testing::ElementsAre(testing::FloatNear(4, 1e-6F), testing::FloatNear(5, 1e-6F)));
  ASSERT_EQ(axes.axes.size(), 1U);  // there is no second
  EXPECT_NEAR(axes.axes[0][0], 0.6, 1e-6);
  EXPECT_NEAR(axes.axes[0][1], 0.8, 1e-6);
  const FloatRows along = place::project(line, axes);
  EXPECT_NEAR(along[0][0], -5, 1e-5);
  EXPECT_NEAR(along[1][0], 0, 1e-5);
  EXPECT_NEAR(along[2][0], 5, 1e-5);
}

TEST(PrincipalAxes, HoldAsMuchVarianceAsTheExactOnes) {
  const FloatRows vectors = decaying(60, 300, 11);
  constexpr std::size_t kCount = 5;
  const PrincipalAxes axes = principal_axes(vectors, kCount);
  ASSERT_EQ(axes.axes.size(), kCount);
  Eigen::MatrixXd centred(300, 60);
  for (Eigen::Index i = 0; i < 300; ++i)
    for (Eigen::Index k = 0; k < 60; ++k)
      centred(i, k) = vectors[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  centred.rowwise() -= centred.colwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> exact(centred.transpose() * centred);
  const FloatRows along = place::project(vectors, axes);
  for (std::size_t k = 0; k < kCount; ++k) {
    double variance = 0;
    for (std::size_t i = 0; i < along.size(); ++i) variance += along[i][k] * along[i][k];
    // Four iterations leave (lambda_15 / lambda_k)^8 of the error: below a thousandth.
    EXPECT_NEAR(variance / exact.eigenvalues()(59 - static_cast<Eigen::Index>(k)), 1, 1e-3) << k;
  }
}

TEST(PrincipalAxes, AreOrthonormal) {
  const PrincipalAxes axes = principal_axes(decaying(40, 100, 2), 10);
  for (std::size_t a = 0; a < axes.axes.size(); ++a)
    for (std::size_t b = 0; b < axes.axes.size(); ++b)
      EXPECT_NEAR(dot(axes.axes[a], axes.axes[b]), a == b ? 1 : 0, 1e-4);  // float arithmetic
}

TEST(PrincipalAxes, AreTheSameForAnyNumberOfThreads) {
  const FloatRows vectors = decaying(80, 1000, 4);
  vo::set_thread_count(1);
  const PrincipalAxes one = principal_axes(vectors, 7);
  vo::set_thread_count(4);
  const PrincipalAxes four = principal_axes(vectors, 7);
  vo::set_thread_count(0);
  EXPECT_EQ(one.axes.values, four.axes.values);
}

TEST(PrincipalAxes, OfOneVectorOrConstantOnesAreNone) {
  EXPECT_EQ(principal_axes({.width = 3, .values = {1, 2, 3}}, 2).axes.size(), 0U);
  const PrincipalAxes axes = principal_axes({.width = 1, .values = std::vector<float>(9, 2)}, 1);
  EXPECT_EQ(axes.axes.size(), 0U);
  EXPECT_EQ(place::project({.width = 1, .values = {2, 2}}, axes).values.size(), 0U);
}

TEST(PrincipalAxes, RefuseNoVectors) {
  EXPECT_THROW(principal_axes({}, 2), std::invalid_argument);
  EXPECT_THROW(principal_axes({.width = 1, .values = {1}}, 0), std::invalid_argument);
}

}  // namespace
