#include <optional>
#include <stdexcept>
#include <support/known_motion.hpp>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/motion/learned_relation.hpp>
#include <vo/motion/motion_model.hpp>

namespace {

using test_support::known_motion;
using test_support::KnownMotion;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::optional<double>> all_of(const KnownMotion& walk, double unit) {
  std::vector<std::optional<double>> known;
  for (const double metres : walk.metres) known.emplace_back(metres / unit);
  return known;
}

double sum(const std::vector<std::optional<double>>& values) {
  double total = 0;
  for (const auto& value : values) total += value.value();
  return total;
}

TEST(LearnMotionModelFromDisplacement, FindsTheRelationItWasMadeBy) {
  const KnownMotion walk = known_motion(40, 0.5, 2);
  const vo::MotionModel model =
      vo::learn_motion_model(walk.errors, walk.metres, std::vector<bool>(walk.frames(), true));
  ASSERT_TRUE(model.learned());
  for (std::size_t k = 1; k < model.error.size(); ++k) {
    // error = way / (1 + 0.3 way); averaging a bent curve over a bin of a twelfth of the pairs moves it
    // little.
    const double way = model.separation[k];
    EXPECT_NEAR(model.error[k], way / (1 + 0.3 * way), 0.01 * way) << way;
  }
}

TEST(LearnMotionModelFromDisplacement, NeedsPairs) {
  const KnownMotion walk = known_motion(10, 1, 1.5);
  EXPECT_FALSE(
      vo::learn_motion_model(walk.errors, walk.metres, std::vector<bool>(walk.frames(), false)).learned());
  EXPECT_THROW(vo::learn_motion_model(walk.errors, std::vector<double>(3), std::vector<bool>(3)),
               std::invalid_argument);
}

TEST(PredictDisplacement, IsRightInTheUnitLearnedFrom) {
  const KnownMotion walk = known_motion(40, 0.5, 2);
  const std::vector<bool> usable(walk.frames(), true);
  for (const double unit : {1.0, 0.01, 30.0}) {
    const auto predicted =
        vo::predict_displacement(walk.errors, walk.time_s, usable, all_of(walk, unit), {0, 500}, {600, 700});
    ASSERT_THAT(predicted, SizeIs(100));
    for (std::size_t i = 0; i < 100; ++i) {
      // Speed swings by a third within the five frames compared, and the least of them is taken.
      EXPECT_NEAR(predicted[i].value() * unit, walk.metres[600 + i], 0.1 * walk.metres[600 + i]) << i;
    }
    EXPECT_NEAR(sum(predicted) * unit, test_support::sum(walk.metres, 600, 700),
                0.03 * test_support::sum(walk.metres, 600, 700));
  }
}

TEST(PredictDisplacement, TakesNothingFromFramesThatAreNotUsable) {
  KnownMotion walk = known_motion(40, 0.5, 2);
  std::vector<bool> usable(walk.frames(), true);
  auto known = all_of(walk, 1);
  const auto before = vo::predict_displacement(walk.errors, walk.time_s, usable, known, {0, 500}, {600, 700});
  for (std::size_t i = 100; i < 120; ++i) {
    known[i] = 50;  // nonsense, marked as such
    usable[i] = false;
  }
  const auto after = vo::predict_displacement(walk.errors, walk.time_s, usable, known, {0, 500}, {600, 700});
  ASSERT_THAT(after, SizeIs(100));
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(after[i].value(), before[i].value(), 0.02 * *before[i]);
}

TEST(PredictDisplacement, SaysNothingWhereNothingIsKnown) {
  const KnownMotion walk = known_motion(10, 1, 1.5);
  const std::vector<bool> usable(walk.frames(), true);
  const std::vector<std::optional<double>> unknown(walk.frames());
  EXPECT_THAT(vo::predict_displacement(walk.errors, walk.time_s, usable, unknown, {0, 100}, {100, 200}),
              IsEmpty());
  EXPECT_THAT(vo::predict_displacement(walk.errors, walk.time_s, usable, all_of(walk, 1), {0, 0}, {100, 200}),
              IsEmpty());
  EXPECT_THROW(vo::predict_displacement(walk.errors, walk.time_s, usable, unknown, {0, 100}, {100, 900}),
               std::invalid_argument);
  EXPECT_THROW(vo::predict_displacement(walk.errors, walk.time_s, {}, unknown, {0, 100}, {100, 200}),
               std::invalid_argument);
}

}  // namespace
