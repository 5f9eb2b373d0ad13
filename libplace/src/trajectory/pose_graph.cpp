#include "trajectory/pose_graph.hpp"

#include "trajectory/pose_graph_errors.hpp"
#include "trajectory/selected_inverse.hpp"

#include <algorithm>
#include <ceres/ceres.h>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCore>

namespace place::pose_graph {
namespace {

template <typename Error, int residuals, int... states>
ceres::CostFunction* cost(const Error& error) {
  return new ceres::AutoDiffCostFunction<Error, residuals, states...>(new Error(error));
}

/// Eigenvalues and eigenvectors. One decomposition with run-time size for all uses: each instance of Eigen's
/// for a fixed size takes seconds to compile.
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(const Matrix& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric);
}

/// R with R' R = information, which is positive semidefinite.
Matrix root_of(const Matrix& information) {
  const auto solver = eigen(information);
  return solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * solver.eigenvectors().transpose();
}

/// The pseudo-inverse: directions with no information, up to rounding, are left out.
Matrix pseudo_inverse(const Matrix& symmetric) {
  const auto solver = eigen(symmetric);
  const Eigen::VectorXd& values = solver.eigenvalues();
  const double least = kCount * std::numeric_limits<double>::epsilon() * values.cwiseAbs().maxCoeff();
  const Eigen::VectorXd inverse =
      values.unaryExpr([&](double value) { return std::abs(value) > least ? 1 / value : 0.0; });
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

/// The graph in Ceres: one parameter block for each node, in the graph's states.
class Problem {
 public:
  Problem(Graph& graph, const DriftCorrectionOptions& options)
      : factors_(graph.fixes.size() + graph.loops.size()) {
    for (State& state : graph.states) problem_.AddParameterBlock(state.value.data(), kCount);
    const auto block = [&](std::size_t node) { return graph.states.at(node).value.data(); };
    problem_.AddResidualBlock(
        cost<PriorError, kCount, kCount>({root_of(graph.prior.information), graph.prior.mean}), nullptr,
        block(0));
    for (std::size_t i = 0; i < graph.motions.size(); ++i) {
      problem_.AddResidualBlock(
          cost<MotionError, kCount, kCount, kCount>(MotionError(graph.motions[i], options)), nullptr,
          block(i), block(i + 1));
    }
    set_weights(graph);
    const double* factor = factors_.data();
    for (const Constraint& fix : graph.fixes) {
      const PlaceError place{fix.sigma_m, fix.aside_m, factor};
      problem_.AddResidualBlock(cost<FixError, 2, kCount>({place, fix.pose}), nullptr, block(fix.node));
      problem_.AddResidualBlock(
          cost<HeadingError, 1, kCount>({options.match_heading_rad, factor, fix.pose.heading_rad}),
          heading_loss(), block(fix.node));
      ++factor;
    }
    for (const Constraint& loop : graph.loops) {
      const PlaceError place{loop.sigma_m, loop.aside_m, factor};
      problem_.AddResidualBlock(cost<LoopError, 2, kCount, kCount>({place}), nullptr, block(loop.earlier),
                                block(loop.node));
      problem_.AddResidualBlock(cost<HeadingError, 1, kCount, kCount>({options.match_heading_rad, factor}),
                                heading_loss(), block(loop.earlier), block(loop.node));
      ++factor;
    }
  }

  /// Copies the graph's weights.
  void set_weights(const Graph& graph) {
    std::size_t i = 0;
    for (const auto* constraints : {&graph.fixes, &graph.loops})
      for (const Constraint& constraint : *constraints)
        factors_[i++] = std::sqrt(constraint.weight * constraint.share);
  }

  /// `tolerance`: relative decrease of the cost at which to stop. False if there is no solution.
  bool minimise(int iterations, double tolerance) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    options.num_threads = 1;  // the order of sums, and so the bytes, would depend on more
    options.max_num_iterations = iterations;
    options.function_tolerance = tolerance;
    options.initial_trust_region_radius =
        1e10;  // Gauss-Newton: damping would hold back the scales, which are weak directions
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  /// J' J at the states, lower triangle; nodes in order.
  Eigen::SparseMatrix<double> information() {
    ceres::CRSMatrix crs;
    problem_.Evaluate({}, nullptr, nullptr, nullptr, &crs);
    const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> jacobian(
        crs.num_rows, crs.num_cols, static_cast<Eigen::Index>(crs.values.size()), crs.rows.data(),
        crs.cols.data(), crs.values.data());
    const Eigen::SparseMatrix<double> columns = jacobian;
    Eigen::SparseMatrix<double> product(crs.num_cols, crs.num_cols);
    product.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
    return product;
  }

  std::vector<double> gradient() {
    std::vector<double> values;
    problem_.Evaluate({}, nullptr, nullptr, &values, nullptr);
    return values;
  }

 private:
  /// On a corner, a place may be recognised a step early or late; its heading is then far off.
  static ceres::LossFunction* heading_loss() { return new ceres::CauchyLoss(1.5); }

  std::vector<double> factors_;  // the costs point to these
  ceres::Problem problem_;
};

/// Squared error of each constraint in its variances: fixes, then loops.
std::vector<double> squared_errors(const Graph& graph) {
  std::vector<double> all;
  constexpr double kOne = 1;
  std::array<double, 2> r{};
  const auto push = [&] { all.push_back(r[0] * r[0] + r[1] * r[1]); };
  for (const Constraint& fix : graph.fixes) {
    FixError{{fix.sigma_m, fix.aside_m, &kOne}, fix.pose}(graph.states[fix.node].value.data(), r.data());
    push();
  }
  for (const Constraint& loop : graph.loops) {
    LoopError{{loop.sigma_m, loop.aside_m, &kOne}}(graph.states[loop.earlier].value.data(),
                                                   graph.states[loop.node].value.data(), r.data());
    push();
  }
  return all;
}

/// Geman and McClure's weights at one stage of non-convexity (Yang et al. 2020, Eq. 12); mu = 1 is their cost
/// itself, a large mu nearly least squares. Returns the largest change.
double reweight(Graph& graph, double mu, const DriftCorrectionOptions& options) {
  const std::vector<double> errors = squared_errors(graph);
  std::size_t i = 0;
  double change = 0;
  for (auto* constraints : {&graph.fixes, &graph.loops}) {
    for (Constraint& constraint : *constraints) {
      const double share = mu * options.outlier_chi2 / (errors[i++] + mu * options.outlier_chi2);
      change = std::max(change, std::abs(share * share - constraint.weight));
      constraint.weight = share * share;
    }
  }
  return change;
}

}  // namespace

Motion motion_between(const vo::Pose2& from, const vo::Pose2& to) {
  Motion motion;
  motion.turn_rad = vo::wrap_angle_rad(to.heading_rad - from.heading_rad);
  const double x = to.x_m - from.x_m, y = to.y_m - from.y_m;
  const auto [forward, right] = seen_from(from.heading_rad + motion.turn_rad / 2, x, y);
  motion.forward_m = forward;
  motion.right_m = right;
  motion.distance_m = std::hypot(x, y);
  return motion;
}

State predicted(const State& state, const Motion& motion) {
  State next = state;
  auto& v = next.value;
  const double turn = std::exp(v[State::kTurnScale]) * motion.turn_rad + v[State::kBias] * motion.distance_m;
  const double scale = std::exp(v[State::kStepScale]);
  // The mirrored turn is its own inverse.
  const auto [x, y] =
      seen_from(v[State::kHeading] + turn / 2, scale * motion.forward_m, scale * motion.right_m);
  v[State::kX] += x;
  v[State::kY] += y;
  v[State::kHeading] += turn;
  return next;
}

Prior prior_at_start(const State& state, bool pose_known, const DriftCorrectionOptions& options) {
  constexpr double kExact = 1e-4;  // metres, radians
  Prior prior;
  prior.mean = Eigen::Map<const Vector>(state.value.data());
  prior.mean.tail<3>().setZero();
  if (pose_known) prior.information.diagonal().head<3>().setConstant(1 / (kExact * kExact));
  const Eigen::Vector3d sd(options.step_scale_sd, options.bias_sd_rad_per_m, options.turn_scale_sd);
  prior.information.diagonal().tail<3>() = sd.cwiseAbs2().cwiseInverse();
  return prior;
}

bool solve(Graph& graph, const DriftCorrectionOptions& options, double most_convex) {
  // Between stages; Yang et al. use 1.4. Walks with up to 70 % wrong matches give the same result with 2 and
  // 8, in time proportional to the number of stages.
  constexpr double kStep = 4;
  constexpr int kIterations = 6, kLastIterations = 30, kMostRounds = 5;
  constexpr double kTolerance = 1e-3, kLastTolerance = 1e-7, kSettled = 0.01;
  const std::vector<State> before = graph.states;
  const std::vector<double> errors = squared_errors(graph);
  const double worst = errors.empty() ? 0 : std::ranges::max(errors);
  Problem problem(graph, options);
  bool usable = true;
  for (double mu = std::clamp(2 * worst / options.outlier_chi2, 1.0, most_convex); mu > 1 && usable;
       mu /= kStep) {
    reweight(graph, mu, options);
    problem.set_weights(graph);
    usable = problem.minimise(kIterations, kTolerance);
  }
  // Geman and McClure's cost itself, until weights and states are consistent.
  double change = 1;
  for (int round = 0; round < kMostRounds && change > kSettled && usable; ++round) {
    change = reweight(graph, 1, options);
    problem.set_weights(graph);
    usable = problem.minimise(kLastIterations, kLastTolerance);
  }
  if (!usable) graph.states = before;
  return usable;
}

std::vector<Eigen::Matrix3d> covariances(const Graph& graph, const DriftCorrectionOptions& options) {
  Graph copy = graph;  // Ceres modifies the states
  const SelectedInverse inverse(Problem(copy, options).information());
  std::vector<Eigen::Matrix3d> all;
  for (std::size_t i = 0; i < graph.states.size(); ++i) {
    const auto first = static_cast<Eigen::Index>(i) * kCount;
    Eigen::Matrix3d& covariance = all.emplace_back();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) covariance(r, c) = inverse.at(first + r, first + c);
  }
  return all;
}

Prior prior_after_first(const Graph& graph, const DriftCorrectionOptions& options) {
  Graph two;
  two.states = {graph.states.at(0), graph.states.at(1)};
  two.motions = {graph.motions.at(0)};
  two.prior = graph.prior;
  for (const Constraint& fix : graph.fixes)
    if (fix.node == 0) two.fixes.push_back(fix);
  Problem problem(two, options);
  const Eigen::MatrixXd lower = problem.information();
  const Eigen::MatrixXd h = lower.selfadjointView<Eigen::Lower>();
  const std::vector<double> g = problem.gradient();
  const Eigen::Map<const Vector> g0(g.data()), g1(g.data() + kCount);
  const Matrix h10 = h.bottomLeftCorner<kCount, kCount>();
  const Matrix h00_inverse = pseudo_inverse(h.topLeftCorner<kCount, kCount>());
  Prior prior;
  prior.information = h.bottomRightCorner<kCount, kCount>() - h10 * h00_inverse * h10.transpose();
  const Vector gradient = g1 - h10 * (h00_inverse * g0);
  prior.mean =
      Eigen::Map<const Vector>(two.states[1].value.data()) - pseudo_inverse(prior.information) * gradient;
  return prior;
}

}  // namespace place::pose_graph
