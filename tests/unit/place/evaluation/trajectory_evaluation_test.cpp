#include "support/drifting_walk.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <place/evaluation/trajectory_evaluation.hpp>
#include <vo/base/rng.hpp>
#include <vo/io/trajectory_io.hpp>

namespace {

using namespace test_support;
using place::evaluate_trajectory;
using place::TrajectoryAlignment;
constexpr double kPi = std::numbers::pi;

TEST(TrajectoryEvaluation, ByHand) {
  // Truth goes north by a metre a second; the estimate is 0, 3, 0 and 4 m off to the side, facing as it
  // should.
  const vo::Trajectory truth{{0, {0, 0, 0}}, {1, {0, 1, 0}}, {2, {0, 2, 0}}, {3, {0, 3, 0}}};
  const vo::Trajectory estimate{{0, {0, 0, 0}}, {1, {3, 1, 0}}, {2, {0, 2, 0}}, {3, {-4, 3, 0}}};
  const auto e = evaluate_trajectory(estimate, truth);
  EXPECT_EQ(e.poses, 4U);
  EXPECT_DOUBLE_EQ(e.end_error_m, 4);
  EXPECT_DOUBLE_EQ(e.ape_m.sse, 25);
  EXPECT_DOUBLE_EQ(e.ape_m.rmse, 2.5);
  EXPECT_DOUBLE_EQ(e.ape_m.mean, 1.75);
  EXPECT_DOUBLE_EQ(e.ape_m.median, 1.5);
  EXPECT_DOUBLE_EQ(e.ape_m.max, 4);
  EXPECT_DOUBLE_EQ(e.ape_m.min, 0);
  EXPECT_DOUBLE_EQ(e.ape_m.sd, std::sqrt(6.25 - 1.75 * 1.75));  // over n
  // From one to the next, 3, 3 and 4 m to the side of the true metre.
  EXPECT_DOUBLE_EQ(e.rpe_m.mean, 10.0 / 3);
  EXPECT_DOUBLE_EQ(e.rpe_m.max, 4);
  // Every second pose: 0 to 2, and no more.
  const auto two = evaluate_trajectory(estimate, truth, {.delta = 2});
  EXPECT_DOUBLE_EQ(two.rpe_m.max, 0);
}

TEST(TrajectoryEvaluation, RelativeErrorsAreSeenFromTheEstimatesOwnHeading) {
  // Right path, but the estimate faces east where the truth faces north: its metre is to the left, not ahead.
  const vo::Trajectory truth{{0, {0, 0, 0}}, {1, {0, 1, 0}}};
  const vo::Trajectory estimate{{0, {0, 0, kPi / 2}}, {1, {0, 1, kPi / 2}}};
  const auto e = evaluate_trajectory(estimate, truth);
  EXPECT_DOUBLE_EQ(e.ape_m.rmse, 0);
  EXPECT_NEAR(e.rpe_m.rmse, std::sqrt(2), 1e-12);
}

TEST(TrajectoryEvaluation, AlignmentUndoesATurnAShiftAndAScale) {
  const vo::Trajectory truth = walk_round_corners(80, 1);
  vo::Trajectory moved = truth;
  for (auto& [time_s, pose] : moved) {
    const double s = std::sin(1.2), c = std::cos(1.2);
    pose = {1.1 * (c * pose.x_m + s * pose.y_m) + 30, 1.1 * (c * pose.y_m - s * pose.x_m) - 5,
            pose.heading_rad + 1.2};
  }
  EXPECT_GT(evaluate_trajectory(moved, truth).ape_m.rmse, 10);
  const auto rigid = evaluate_trajectory(moved, truth, {.alignment = TrajectoryAlignment::kRigid});
  EXPECT_GT(rigid.ape_m.rmse, 0.1);
  EXPECT_NEAR(rigid.rpe_m.mean, 0.05, 1e-9);  // a tenth of the half metre between nodes
  const auto scaled = evaluate_trajectory(moved, truth, {.alignment = TrajectoryAlignment::kScaled});
  EXPECT_NEAR(scaled.ape_m.rmse, 0, 1e-9);
  EXPECT_NEAR(scaled.rpe_m.rmse, 0, 1e-9);
}

TEST(TrajectoryEvaluation, AlignmentIsTheBestThereIs) {
  const vo::Trajectory truth = walk_round_corners(60, 2);
  const vo::Trajectory estimate = drifted(truth, {.step_scale = 1.1, .turn_noise_rad = 0.05});
  const double best =
      evaluate_trajectory(estimate, truth, {.alignment = TrajectoryAlignment::kRigid}).ape_m.sse;
  for (double turn = -3; turn <= 3; turn += 0.05) {
    for (double x = -3; x <= 3; x += 1) {
      vo::Trajectory tried = estimate;
      for (auto& [time_s, pose] : tried)
        pose = {std::cos(turn) * pose.x_m + std::sin(turn) * pose.y_m + x,
                std::cos(turn) * pose.y_m - std::sin(turn) * pose.x_m, pose.heading_rad};
      EXPECT_GE(evaluate_trajectory(tried, truth).ape_m.sse, best - 1e-9);
    }
  }
}

TEST(TrajectoryEvaluation, PairsEachPoseOfTheShorterWithTheNearest) {
  const vo::Trajectory few{{0.004, {}}, {0.5, {}}, {1.0, {}}};
  const vo::Trajectory many{{0, {}}, {0.006, {}}, {0.49, {}}, {0.52, {}}, {2, {}}};
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  EXPECT_EQ(place::pair_poses(few, many, 0.0101), (Pairs{{0, 1}, {1, 2}}));
  EXPECT_EQ(place::pair_poses(many, few, 0.0101), (Pairs{{1, 0}, {2, 1}}));
  EXPECT_EQ(place::pair_poses(few, many, 0.001), Pairs{});
}

TEST(TrajectoryEvaluation, NothingAndOnePose) {
  const vo::Trajectory one{{0, {1, 2, 3}}};
  EXPECT_EQ(evaluate_trajectory({}, one).poses, 0U);
  const auto e = evaluate_trajectory(one, one);
  EXPECT_EQ(e.poses, 1U);
  EXPECT_EQ(e.ape_m.rmse, 0);
  EXPECT_THROW(evaluate_trajectory(one, one, {.delta = 0}), std::invalid_argument);
  EXPECT_THROW(place::pair_poses(one, one, -1), std::invalid_argument);
}

/// Poses in space, as evo holds a TUM file: 4x4 matrices of its positions and quaternions.
std::vector<Eigen::Isometry3d> in_space(const std::string& tum) {
  std::vector<Eigen::Isometry3d> poses;
  std::istringstream lines(tum);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream values(line);
    double time_s = 0, x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 0;
    values >> time_s >> x >> y >> z >> qx >> qy >> qz >> qw;
    poses.push_back(Eigen::Translation3d(x, y, z) * Eigen::Quaterniond(qw, qx, qy, qz).normalized());
  }
  return poses;
}

/// evo's statistics that matter here.
std::pair<double, double> rmse_and_sd(const std::vector<double>& errors) {
  const Eigen::Map<const Eigen::ArrayXd> e(errors.data(), static_cast<Eigen::Index>(errors.size()));
  return {std::sqrt(e.square().mean()), std::sqrt((e - e.mean()).square().mean())};
}

TEST(TrajectoryEvaluation, EqualsEvosFormulasOnWhatItReadsOfOurFiles) {
  // evo 1.x: metrics.APE and metrics.RPE with the translation part, after geometry.umeyama_alignment; in
  // space, where ours is in the plane.
  const vo::Trajectory truth = walk_round_corners(60, 3);
  vo::Trajectory estimate = truth;
  vo::Rng rng(5);
  for (auto& [time_s, pose] : estimate) {
    const double along = 0.03 * time_s;
    pose = {1.05 * pose.x_m + along + rng.normal() * 0.2, 1.05 * pose.y_m - 2 * along + rng.normal() * 0.2,
            pose.heading_rad + 0.05 * rng.normal()};
  }
  for (const auto alignment :
       {TrajectoryAlignment::kNone, TrajectoryAlignment::kRigid, TrajectoryAlignment::kScaled}) {
    const std::vector<Eigen::Isometry3d> q = in_space(vo::to_tum(truth));
    std::vector<Eigen::Isometry3d> p = in_space(vo::to_tum(estimate));
    ASSERT_EQ(p.size(), q.size());
    const auto n = static_cast<Eigen::Index>(p.size());
    Eigen::Matrix3Xd from(3, n), to(3, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      from.col(i) = p[static_cast<std::size_t>(i)].translation();
      to.col(i) = q[static_cast<std::size_t>(i)].translation();
    }
    if (alignment != TrajectoryAlignment::kNone) {
      const Eigen::Matrix4d t = Eigen::umeyama(from, to, alignment == TrajectoryAlignment::kScaled);
      const double scale = std::cbrt(t.topLeftCorner<3, 3>().determinant());
      for (Eigen::Isometry3d& pose : p) {
        pose.translation() = (t.topLeftCorner<3, 3>() * pose.translation() + t.topRightCorner<3, 1>()).eval();
        pose.linear() = (t.topLeftCorner<3, 3>() / scale * pose.linear()).eval();
      }
    }
    std::vector<double> ape;
    for (std::size_t i = 0; i < p.size(); ++i)
      ape.push_back((p[i].translation() - q[i].translation()).norm());
    for (const std::size_t delta : {1U, 7U}) {
      std::vector<double> rpe;
      for (std::size_t i = 0; i + delta < p.size(); i += delta) {
        const Eigen::Isometry3d moved = p[i].inverse() * p[i + delta], truly = q[i].inverse() * q[i + delta];
        rpe.push_back((truly.inverse() * moved).translation().norm());
      }
      const auto ours = evaluate_trajectory(estimate, truth, {.alignment = alignment, .delta = delta});
      constexpr double kSixDecimals_m = 1e-5;  // of the file, and of what is computed from them
      EXPECT_EQ(ours.poses, p.size());
      EXPECT_NEAR(ours.ape_m.rmse, rmse_and_sd(ape).first, kSixDecimals_m);
      EXPECT_NEAR(ours.ape_m.sd, rmse_and_sd(ape).second, kSixDecimals_m);
      EXPECT_NEAR(ours.rpe_m.rmse, rmse_and_sd(rpe).first, kSixDecimals_m) << delta;
      EXPECT_NEAR(ours.rpe_m.sd, rmse_and_sd(rpe).second, kSixDecimals_m) << delta;
    }
  }
}

}  // namespace
