#include "place/describe/principal_axes.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace place {
namespace {

/// Rows of floats as the columns of a matrix: the same places in memory.
Eigen::Map<const Eigen::MatrixXf> as_columns(const FloatRows& rows) {
  return {rows.values.data(), static_cast<Eigen::Index>(rows.width), static_cast<Eigen::Index>(rows.size())};
}

FloatRows as_rows(const Eigen::MatrixXf& columns) {
  return {.width = static_cast<std::size_t>(columns.rows()),
          .values = {columns.data(), columns.data() + columns.size()}};
}

std::vector<float> mean_of(const FloatRows& rows) {
  std::vector<double> sums(rows.width);
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::ranges::transform(sums, rows[i], sums.begin(), std::plus<>());
  std::vector<float> mean;
  for (const double sum : sums) mean.push_back(static_cast<float>(sum / static_cast<double>(rows.size())));
  return mean;
}

FloatRows centred_on(const std::vector<float>& mean, FloatRows rows) {
  vo::parallel_for(rows.size(), [&](std::size_t i) {
    std::ranges::transform(rows[i], mean, rows[i].begin(), std::minus<>());
  });
  return rows;
}

/// The eigenvectors of a symmetric matrix's largest eigenvalues, largest first.
struct Leading {
  FloatRows vectors;
  std::vector<float> values;
};

Leading leading_vectors(const FloatRows& symmetric, std::size_t wanted) {
  const std::size_t size = symmetric.size();
  // A few more than wanted, so that few iterations are enough (section 4.5 there).
  const std::size_t tried = std::min(wanted + 16, size);
  const RowPanels panels(symmetric);
  FloatRows basis = make_float_rows(size, tried);
  if (tried < size) {
    constexpr int kIterations = 4;
    vo::Rng rng(1);
    for (float& value : basis.values) value = static_cast<float>(rng.normal());
    for (int i = 0; i < kIterations; ++i) {
      const Eigen::HouseholderQR<Eigen::MatrixXf> qr(as_columns(panels.products(basis)));
      const auto rows = static_cast<Eigen::Index>(size), columns = static_cast<Eigen::Index>(tried);
      basis = as_rows(qr.householderQ() * Eigen::MatrixXf::Identity(rows, columns));
    }
  } else {
    for (std::size_t i = 0; i < size; ++i) basis[i][i] = 1;
  }
  const FloatRows within = RowPanels(basis).products(panels.products(basis));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> solver(as_columns(within));
  const auto last = static_cast<Eigen::Index>(wanted);
  const Eigen::MatrixXf weights = solver.eigenvectors().rightCols(last).rowwise().reverse();
  const Eigen::VectorXf values = solver.eigenvalues().tail(last).reverse();
  return {.vectors = RowPanels::of_columns(basis).products(as_rows(weights)),
          .values = {values.begin(), values.end()}};
}

}  // namespace

PrincipalAxes principal_axes(const FloatRows& vectors, std::size_t count) {
  if (vectors.size() == 0 || count == 0)
    throw std::invalid_argument("principal_axes: vectors and a count of at least 1 expected");
  PrincipalAxes result{.mean = mean_of(vectors), .axes = {.width = vectors.width, .values = {}}};
  const FloatRows centred = centred_on(result.mean, vectors);

  // The products of all pairs of columns or of all pairs of rows, whichever are fewer: their leading vectors
  // are the axes, or the weights of the vectors that sum to them.
  const std::size_t wanted = std::min({count, vectors.width, vectors.size()});
  const bool by_columns = vectors.width <= vectors.size();
  const Leading leading =
      leading_vectors(by_columns ? products_of_columns(centred) : products_of_rows(centred), wanted);
  FloatRows axes = by_columns ? leading.vectors : RowPanels::of_columns(centred).products(leading.vectors);
  constexpr float kRounding = 1e-6F;  // of the largest variance; anything below is rounding
  for (std::size_t i = 0; i < wanted && leading.values[i] > kRounding * leading.values[0]; ++i) {
    Eigen::Map<Eigen::VectorXf> axis(axes[i].data(), static_cast<Eigen::Index>(axes.width));
    axis.normalize();
    Eigen::Index peak = 0;
    axis.cwiseAbs().maxCoeff(&peak);
    if (axis(peak) < 0) axis = -axis;
    result.axes.values.insert(result.axes.values.end(), axis.begin(), axis.end());
  }
  return result;
}

Projection::Projection(const PrincipalAxes& axes) : panels_(axes.axes), offset_(axes.axes.size()) {
  if (axes.mean.empty() || offset_.empty()) return;
  offset_ = panels_.products({.width = axes.mean.size(), .values = axes.mean}).values;
}

FloatRows Projection::operator()(const FloatRows& vectors) const {
  if (vectors.values.empty() || offset_.empty()) return make_float_rows(offset_.size(), vectors.size());
  return centred_on(offset_, panels_.products(vectors));
}

FloatRows project(const FloatRows& vectors, const PrincipalAxes& axes) {
  return Projection(axes)(vectors);
}

}  // namespace place
