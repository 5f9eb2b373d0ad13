#include "support/rendered_room.hpp"

#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <place/evaluation/kitti_evaluation.hpp>

namespace {

using test_support::turned;

constexpr double kDegree = std::numbers::pi / 180;

/// Straight on, a metre a frame, `scale` too long, drifting to the right by `drift_deg` a metre.
std::vector<vo::Pose3> drive(int frames, double scale = 1, double drift_deg = 0) {
  std::vector<vo::Pose3> poses{{}};
  for (int i = 1; i < frames; ++i)
    poses.push_back(vo::compose(poses.back(), turned(drift_deg * kDegree, {0, 0, scale})));
  return poses;
}

std::vector<std::optional<vo::Pose3>> known(const std::vector<vo::Pose3>& poses) {
  return {poses.begin(), poses.end()};
}

TEST(KittiEvaluation, OfTheTruthIsZero) {
  const auto truth = drive(250);
  auto moved = known(truth);  // in another world
  for (auto& pose : moved) pose = vo::compose(turned(1, {5, 6, 7}), *pose);
  const auto result = place::evaluate_kitti(truth, moved);
  EXPECT_LT(result.all.translation_pct, 1e-9);
  EXPECT_LT(result.all.rotation_deg_per_m, 1e-9);
  // A stretch of 100 m ends at the first frame beyond it, 101 m on: starts 0, 10, ..., 140 of frames to 249.
  EXPECT_EQ(result.by_length[0].stretches, 15U);
  EXPECT_EQ(result.by_length[1].stretches, 5U);
  EXPECT_EQ(result.by_length[2].stretches, 0U);
  EXPECT_EQ(result.all.stretches, 20U);
  EXPECT_EQ(result.unknown, 0U);
}

TEST(KittiEvaluation, OfAScaleErrorByHand) {
  const auto truth = drive(250);
  const auto result = place::evaluate_kitti(truth, known(drive(250, 1.1)));
  EXPECT_NEAR(result.by_length[0].translation_pct, 100 * 0.1 * 101 / 100, 1e-9);
  EXPECT_NEAR(result.by_length[1].translation_pct, 100 * 0.1 * 201 / 200, 1e-9);
  EXPECT_NEAR(result.all.translation_pct, (15 * 10.1 + 5 * 10.05) / 20, 1e-9);
  EXPECT_LT(result.all.rotation_deg_per_m, 1e-9);
}

TEST(KittiEvaluation, OfADriftingHeadingByHand) {
  const auto result = place::evaluate_kitti(drive(250), known(drive(250, 1, 0.02)));
  EXPECT_NEAR(result.by_length[0].rotation_deg_per_m, 0.02 * 101 / 100, 1e-9);
  // An arc of 101 m that turns by 2.02 degrees leaves its tangent by 101 * 0.03526 / 2 = 1.78 m.
  EXPECT_NEAR(result.by_length[0].translation_pct, 1.78, 0.02);
}

TEST(KittiEvaluation, LeavesOutWhatIsNotKnown) {
  const auto truth = drive(250);
  auto estimate = known(truth);
  estimate[0].reset();
  estimate[111].reset();  // where the stretch from frame 10 ends
  const auto result = place::evaluate_kitti(truth, estimate, {.lengths_m = {100}});
  EXPECT_EQ(result.unknown, 2U);
  EXPECT_EQ(result.all.stretches, 13U);
}

TEST(KittiEvaluation, TakesTheScaleFromTheBeginning) {
  const auto truth = drive(250);
  auto estimate = known(drive(250, 0.25));
  EXPECT_NEAR(place::metres_per_unit(truth, estimate, 50).value(), 4, 1e-12);
  for (std::size_t i = 60; i < 250; ++i) estimate[i]->position *= 9;  // later it does not count
  EXPECT_NEAR(place::metres_per_unit(truth, estimate, 50).value(), 4, 1e-12);
  estimate[0].reset();
  EXPECT_NEAR(place::metres_per_unit(truth, estimate, 50).value(), 4, 1e-12);
  estimate[20].reset();
  EXPECT_FALSE(place::metres_per_unit(truth, estimate, 50));
  EXPECT_FALSE(place::metres_per_unit(truth, std::vector<std::optional<vo::Pose3>>(250, vo::Pose3{}), 50));
  EXPECT_FALSE(place::metres_per_unit(truth, std::vector<std::optional<vo::Pose3>>(250), 50));
}

TEST(KittiEvaluation, OfNothingIsNothing) {
  EXPECT_EQ(place::evaluate_kitti({}, {}).all.stretches, 0U);
  EXPECT_EQ(place::evaluate_kitti(drive(1), known(drive(1))).all.stretches, 0U);
  EXPECT_THROW(place::evaluate_kitti(drive(2), known(drive(1))), std::invalid_argument);
  EXPECT_THROW(place::evaluate_kitti({}, {}, {.lengths_m = {0}}), std::invalid_argument);
  EXPECT_THROW(place::evaluate_kitti({}, {}, {.every = 0}), std::invalid_argument);
}

}  // namespace
