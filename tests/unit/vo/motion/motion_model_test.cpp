#include "support/made_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/motion/motion_model.hpp>

namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

/// Errors of a walk at the given speeds (per frame, 10 a second) whose alignment error is
/// `error_of(distance)`.
template <typename ErrorOf>
vo::AlignmentErrors errors_of(const std::vector<double>& speed, std::size_t spans, ErrorOf error_of) {
  std::vector<double> travelled{0};
  for (const double v : speed) travelled.push_back(travelled.back() + v);
  return test_support::made_errors(travelled.size(), 10, spans, [&](std::size_t i, std::size_t j) {
    return error_of(travelled[j] - travelled[i]);
  });
}

double linear(double distance) {
  return 0.05 * distance;
}

std::vector<double> times(std::size_t frames) {
  std::vector<double> time_s(frames);
  for (std::size_t i = 0; i < frames; ++i) time_s[i] = static_cast<double>(i) / 10;
  return time_s;
}

double mean(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return sum / static_cast<double>(end - begin);
}

TEST(LearnMotionModel, KeepsThePartThatIncreases) {
  const auto model = vo::learn_motion_model(
      {.seconds = {0, 0.04, 0.08, 0.1, 0.16, 0.2}, .error = {0, 0.1, 0.3, 0.4, 0.35, 0.6}});
  EXPECT_THAT(model.error, ElementsAre(0, 0.1, 0.3, 0.4));
  EXPECT_THAT(model.separation, ElementsAre(0, 0.04, 0.08, 0.1));
  EXPECT_TRUE(model.learned());
}

TEST(LearnMotionModel, LearnsNothingFromNoMotion) {
  for (const auto& errors : {std::vector<double>{}, {0}, {0, 0, 0}, {0, -0.1, 0.2}, {0, std::nan("")}}) {
    const auto model =
        vo::learn_motion_model({.seconds = std::vector<double>(errors.size(), 1), .error = errors});
    EXPECT_FALSE(model.learned());
    EXPECT_THAT(vo::separation_of(model, std::vector<float>{0, 0.5F, 9}), Each(0));
  }
}

TEST(SeparationOf, ReproducesAQuadraticRelation) {
  // separation = 2 e + 3 e^2: a second-order spline holds it exactly.
  vo::MotionModel model;
  for (int s = 0; s <= 8; ++s) {
    model.separation.push_back(s);
    model.error.push_back((-2 + std::sqrt(4.0 + 12 * s)) / 6);
  }
  for (double e = 0; e < model.error.back(); e += 0.01) {
    const auto error = static_cast<float>(e);
    const double exact = 2.0 * error + 3.0 * error * error;
    // The curve is tabulated to 1e-5 frames; the spline itself is right to rounding.
    EXPECT_NEAR(vo::separation_of(model, std::vector<float>{error})[0], exact, 2e-5) << e;
  }
}

TEST(SeparationOf, IsClampedAtBothEnds) {
  const vo::MotionModel model{.error = {0, 0.2, 0.3, 0.35}, .separation = {0, 1, 2, 3}};
  const auto separations = vo::separation_of(model, std::vector<float>{0, 0.35F, 0.5F, 100});
  EXPECT_EQ(separations[0], 0);
  EXPECT_NEAR(separations[1], 3, 1e-5);  // 0.35 is no float
  EXPECT_NEAR(separations[2], 3, 1e-9);
  EXPECT_NEAR(separations[3], 3, 1e-9);
}

TEST(SeparationOf, DoesNotDecreaseAndKeepsToTheKnots) {
  // Knots at random errors, often so uneven that a quadratic through them overshoots.
  vo::Rng rng(1);
  for (int round = 0; round < 50; ++round) {
    SCOPED_TRACE(round);
    vo::MotionModel model{.error = {0}, .separation = {0}};
    for (int s = 1; s <= 6; ++s) {
      model.error.push_back(model.error.back() + std::exp(rng.uniform(-3, 1)));
      model.separation.push_back(s);
    }
    std::vector<float> errors;
    for (int i = 0; i <= 1000; ++i) errors.push_back(static_cast<float>(model.error.back() * i / 1000));
    EXPECT_TRUE(std::ranges::is_sorted(vo::separation_of(model, errors)));
    const std::vector<float> knots(model.error.begin(), model.error.end());
    const auto at_knots = vo::separation_of(model, knots);
    for (std::size_t s = 0; s < knots.size(); ++s) {
      // A straight piece bends at a knot: between points of the table (1/4096 of the range) the knot is cut
      // by at most the steeper slope times a step.
      double steepest = 0;
      for (std::size_t k = 1; k < knots.size(); ++k)
        steepest = std::max(steepest, 1 / (model.error[k] - model.error[k - 1]));
      EXPECT_NEAR(at_knots[s], static_cast<double>(s), steepest * model.error.back() / 4096 + 1e-5);
    }
  }
}

TEST(SeparationOf, WorksFromTwoKnots) {
  // A straight line through (0, 0) and (0.5, 1).
  const vo::MotionModel model{.error = {0, 0.5}, .separation = {0, 1}};
  EXPECT_THAT(vo::separation_of(model, std::vector<float>{0.125F, 0.25F}),
              ElementsAre(testing::DoubleNear(0.25, 1e-9), testing::DoubleNear(0.5, 1e-9)));
  EXPECT_THAT(vo::separation_of(model, {}), IsEmpty());
}

TEST(EstimateMotion, OfASteadyWalkIsASecondASecond) {
  const auto errors =
      errors_of(std::vector<double>(99, 3.7), 10, [](double d) { return 1 - std::exp(-d / 30); });
  const auto displacement = vo::estimate_motion(errors, {}, times(100));
  ASSERT_EQ(displacement.size(), 100U);
  EXPECT_EQ(displacement[0], 0);
  // Every mean error is the error of every frame, so all that is left is the table's 1e-5 and floats.
  for (std::size_t i = 1; i < 100; ++i) EXPECT_NEAR(displacement[i], 0.1, 1e-5) << i;
}

TEST(EstimateMotion, FollowsTheSpeed) {
  std::vector<double> speed(399, 0.5);
  std::fill(speed.begin() + 200, speed.end(), 1.5);
  for (const int separations : {1, 5}) {
    const auto displacement =
        vo::estimate_motion(errors_of(speed, 10, linear), {}, times(400), {.separations = separations});
    // The mean errors of large separations miss the walk's ends, 10 of 400 frames; the step from slow to
    // fast is smeared over as many frames as there are separations.
    for (std::size_t i = 1; i <= 195; ++i) EXPECT_NEAR(displacement[i], 0.05, 0.05 * 10 / 400) << i;
    for (std::size_t i = 206; i < 400; ++i) EXPECT_NEAR(displacement[i], 0.15, 0.15 * 10 / 400) << i;
  }
}

TEST(EstimateMotion, GivesTheSmallestOfTheSeparationsEstimates) {
  // More separations can only lower an estimate.
  vo::Rng rng(2);
  std::vector<double> speed(200);
  for (double& v : speed) v = rng.uniform(0.2, 1.8);
  const auto errors = errors_of(speed, 10, linear);
  std::vector<double> before = vo::estimate_motion(errors, {}, times(201), {.separations = 1});
  bool any_lower = false;
  for (int separations = 2; separations <= 10; ++separations) {
    const auto now = vo::estimate_motion(errors, {}, times(201), {.separations = separations});
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_LE(now[i], before[i]) << i;
      any_lower |= now[i] < before[i];
    }
    before = now;
  }
  EXPECT_TRUE(any_lower);
}

TEST(EstimateMotion, SeesThroughBounce) {
  // Half the walk stands; sway adds 0.1 to every error, as two frames of walking do.
  std::vector<double> speed(400, 1.0);
  std::fill(speed.begin() + 200, speed.end(), 0.0);
  const auto errors = errors_of(speed, 10, [](double d) { return linear(d) + 0.1; });
  const auto ratio = [&](int separations) {
    const auto displacement = vo::estimate_motion(errors, {}, times(401), {.separations = separations});
    return mean(displacement, 220, 380) / mean(displacement, 20, 180);
  };
  // The walk's mean speed is 1/2, so its mean errors are 0.1 + 0.025 k. By single steps: walking, 0.15, is
  // 2 frames of mean speed; standing, 0.1, lies 4/5 along the first piece, 0 to 0.125. Over 5 frames standing
  // is 0.1 as well, but shared by five. The slack is for the spline's bend beside a straight first piece.
  EXPECT_NEAR(ratio(1), 0.8 / 2, 0.04);
  EXPECT_NEAR(ratio(5), 0.8 / 5 / 2, 0.008);
}

TEST(EstimateMotion, NoFrameIsFasterThanTheLimit) {
  std::vector<double> speed(300, 1.0);
  std::fill(speed.begin() + 100, speed.begin() + 110, 8.0);  // a turn
  const auto errors = errors_of(speed, 10, linear);
  const auto capped = vo::estimate_motion(errors, {}, times(301), {.separations = 1, .max_speed = 1.5});
  const auto free = vo::estimate_motion(
      errors, {}, times(301), {.separations = 1, .max_speed = std::numeric_limits<double>::infinity()});
  const auto time_s = times(301);
  EXPECT_NEAR(*std::ranges::max_element(capped), 0.15, 1e-12);
  EXPECT_GT(*std::ranges::max_element(free), 0.4);
  for (std::size_t i = 1; i < free.size(); ++i)
    EXPECT_DOUBLE_EQ(capped[i], std::min(free[i], 1.5 * (time_s[i] - time_s[i - 1]))) << i;
}

TEST(EstimateMotion, DoesNotLearnFromExcludedFrames) {
  std::vector<double> speed(300, 1.0);
  std::fill(speed.begin() + 100, speed.begin() + 200, 1.9);
  const auto errors = errors_of(speed, 10, linear);
  std::vector<bool> excluded(301, false);
  std::fill(excluded.begin() + 85, excluded.begin() + 205, true);
  const auto displacement = vo::estimate_motion(errors, excluded, times(301));
  // What is left for learning is steady at speed 1, so the rest is measured in it: exact but for the table's
  // 1e-5 and floats.
  EXPECT_NEAR(displacement[50], 0.1, 1e-5);
  EXPECT_NEAR(displacement[150], 0.19, 1e-5);
}

TEST(EstimateMotion, ALocalWindowFollowsTheScene) {
  // A steady walk into a scene that changes half as much for the same way.
  auto errors = errors_of(std::vector<double>(399, 1.0), 10, linear);
  for (auto& comparisons : errors.by_span)
    for (std::size_t i = 200; i < comparisons.size(); ++i) comparisons[i].error /= 2;
  const auto whole = vo::estimate_motion(errors, {}, times(400));
  const auto local = vo::estimate_motion(errors, {}, times(400), {.local_window_s = 5});
  EXPECT_NEAR(mean(whole, 300, 390) / mean(whole, 20, 150), 0.5, 0.05);
  // 5 s after the change the window holds nothing of the old scene: exact but for the table's 1e-5.
  EXPECT_NEAR(mean(local, 300, 380), 0.1, 1e-5);
  EXPECT_NEAR(mean(local, 20, 150), 0.1, 1e-5);

  // A window as long as the walk is the whole walk.
  EXPECT_EQ(vo::estimate_motion(errors, {}, times(400), {.local_window_s = 40}), whole);
}

TEST(EstimateMotion, OfWalksWithoutMotionIsZero) {
  const auto still = errors_of(std::vector<double>(20, 0.0), 10, linear);
  EXPECT_THAT(vo::estimate_motion(still, {}, times(21)), Each(0));
  EXPECT_THAT(vo::estimate_motion(errors_of({}, 10, linear), {}, times(1)), ElementsAre(0));
  // Two frames: the one step there is, is the mean.
  EXPECT_THAT(vo::estimate_motion(errors_of({2}, 10, linear), {}, times(2)),
              ElementsAre(0, testing::DoubleNear(0.1, 1e-5)));
}

TEST(EstimateMotion, IsTheSameAtAnyFrameRateAndWhereItChanges) {
  // A wall that a camera passes at a speed that swings: the error grows with the way and flattens out.
  const auto place = [](double s) { return s + 0.8 * std::sin(0.7 * s); };
  const auto moved = [&](const std::vector<double>& time_s) {
    vo::AlignmentErrors errors = vo::alignment_errors(vo::make_image_stack(1, 1, time_s.size()), time_s);
    for (auto& comparisons : errors.by_span) {
      for (std::size_t i = 0; i < comparisons.size(); ++i) {
        const double way = place(time_s[i + comparisons[i].frames]) - place(time_s[i]);
        comparisons[i].error = static_cast<float>(way / (0.1 + way));
      }
    }
    std::vector<double> travelled(1);
    for (const double d : vo::estimate_motion(errors, {}, time_s)) travelled.push_back(travelled.back() + d);
    return travelled;
  };
  const auto clock = [](const auto& frame_s) {
    std::vector<double> time_s{0};
    while (time_s.back() < 90) time_s.push_back(time_s.back() + frame_s(time_s.back()));
    return time_s;
  };
  const auto rate = [](double hz) { return [hz](double) { return 1 / hz; }; };
  const double at_25 = moved(clock(rate(25))).back();
  // The mean errors fit the time, so the sum is the walk's length but for the bend of the curve.
  EXPECT_NEAR(at_25, 90, 5);
  // At 16.7 and 20 frames a second two spans fall on the same frames.
  for (const double hz : {12.5, 1 / 0.06, 20.0, 24.0, 30.0, 50.0, 60.0})
    EXPECT_NEAR(moved(clock(rate(hz))).back(), at_25, 0.03 * at_25) << hz;
  const auto by_seconds = [](double s) { return static_cast<int>(s + 1e-9) % 2 == 0 ? 0.04 : 0.08; };
  // Odd spans are compared in the even seconds alone, in which the camera is not as fast as in the others.
  EXPECT_NEAR(moved(clock(by_seconds)).back(), at_25, 0.03 * at_25);
}

TEST(ApplyMotionModel, SaysNothingOverAJumpOfTheClock) {
  std::vector<double> time_s = times(200);
  for (std::size_t i = 100; i < 200; ++i) time_s[i] += 4;
  vo::AlignmentErrors errors = vo::alignment_errors(vo::make_image_stack(1, 1, 200), time_s);
  for (auto& comparisons : errors.by_span)
    for (vo::Comparison& compared : comparisons) compared.error = compared.seconds;
  const auto moved =
      vo::apply_motion_model(errors, vo::learn_motion_model(vo::mean_errors(errors)), time_s, 5, 2);
  for (std::size_t i = 0; i < 200; ++i) EXPECT_EQ(moved[i].has_value(), i != 100) << i;
  EXPECT_EQ(vo::estimate_motion(errors, {}, time_s)[100], 0);
}

TEST(EstimateMotion, RefusesOptionsOutOfRange) {
  const auto errors = errors_of({1, 1, 1}, 2, linear);
  EXPECT_NO_THROW(vo::estimate_motion(errors, {}, times(4), {.separations = 2}));
  EXPECT_THROW(vo::estimate_motion(errors, {}, times(4), {.separations = 0}), std::invalid_argument);
  EXPECT_THROW(vo::estimate_motion(errors, {}, times(4), {.separations = 3}), std::invalid_argument);
  EXPECT_THROW(vo::estimate_motion(errors, {}, times(4), {.separations = 1, .max_speed = 0}),
               std::invalid_argument);
  EXPECT_THROW(vo::estimate_motion(errors, {}, times(3), {.separations = 1}), std::invalid_argument);
}

TEST(EstimateMotion, GoesOnWithTheLastModelWhereAWindowTeachesNothing) {
  const auto errors = errors_of(std::vector<double>(399, 1.0), 10, linear);
  std::vector<bool> excluded(400);
  std::fill(excluded.begin() + 150, excluded.begin() + 300, true);
  const auto moved = vo::estimate_motion(errors, excluded, times(400), {.local_window_s = 5});
  EXPECT_NEAR(moved[250], 0.1, 1e-5);
}

TEST(EstimateMotion, ComparesNeighboursAtTheirOwnDistance) {
  // At 12.5 frames a second no two frames are one span apart.
  constexpr double kRate_hz = 12.5;
  std::vector<double> time_s;
  for (int i = 0; i < 200; ++i) time_s.push_back(i / kRate_hz);
  vo::AlignmentErrors errors = vo::alignment_errors(vo::make_image_stack(1, 1, time_s.size()), time_s);
  for (auto& comparisons : errors.by_span)
    for (vo::Comparison& comparison : comparisons) comparison.error = comparison.seconds;
  const auto moved = vo::estimate_motion(errors, {}, time_s, {.separations = 1});
  EXPECT_NEAR(moved[100], 1 / kRate_hz, 1e-3);
}

}  // namespace
