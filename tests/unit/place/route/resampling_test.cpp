#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/resampling.hpp>
#include <vo/base/rng.hpp>

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The definition: the frames nearest to 0, unit, 2 unit, ... up to the walk's end; of equally near ones the
/// later.
std::vector<std::size_t> nearest_frames(const std::vector<double>& displacement, double unit) {
  std::vector<double> travelled(displacement.size());
  std::partial_sum(displacement.begin() + 1, displacement.end(), travelled.begin() + 1);
  std::vector<std::size_t> keyframes{0};
  for (double place = unit; place <= travelled.back(); place += unit) {
    // The first frame that has come as far as the place, or the one before it.
    const auto reached =
        static_cast<std::size_t>(std::ranges::lower_bound(travelled, place) - travelled.begin());
    const bool earlier = place - travelled[reached - 1] < travelled[reached] - place;
    const std::size_t nearest = earlier ? reached - 1 : reached;
    if (nearest > keyframes.back()) keyframes.push_back(nearest);
  }
  return keyframes;
}

std::vector<double> times(std::size_t frames, double rate_hz = 25) {
  std::vector<double> time_s;
  for (std::size_t i = 0; i < frames; ++i) time_s.push_back(static_cast<double>(i) / rate_hz);
  return time_s;
}

TEST(SamplingUnit, WorkedExample) {
  // Without the first: 1, 3. Mean 2, population deviation 1: 3 (2 + 2 * 1).
  EXPECT_NEAR(place::sampling_unit(std::vector<double>{99, 1, 3}, times(3), 3), 12, 1e-12);
}

TEST(SamplingUnit, OfSteadyAndOfNoMotion) {
  EXPECT_NEAR(place::sampling_unit(std::vector<double>(11, 0.5), times(11), 6), 3, 1e-6);
  EXPECT_EQ(place::sampling_unit(std::vector<double>(11, 0), times(11), 6), 0);
  EXPECT_DOUBLE_EQ(place::sampling_unit(std::vector<double>{0, 2}, times(2), 1), 2);
}

TEST(SamplingUnit, IsTheSameHoweverLongTheWalkerStands) {
  std::vector<double> walk{0};
  for (int i = 0; i < 100; ++i) walk.push_back(i % 2 == 0 ? 1 : 2);
  const double unit = place::sampling_unit(walk, times(walk.size()), 6);
  walk.insert(walk.begin() + 30, 500, 0.0);
  EXPECT_NEAR(place::sampling_unit(walk, times(walk.size()), 6), unit, 1e-9);
}

TEST(SamplingUnit, IsTheSameAtAnyFrameRateAndWhereItChanges) {
  // A metre a second and two by turns of a second.
  const auto unit = [](const std::vector<double>& time_s) {
    std::vector<double> moved(time_s.size(), 0);
    for (std::size_t i = 1; i < time_s.size(); ++i)
      moved[i] = (time_s[i] - time_s[i - 1]) * (static_cast<int>(time_s[i] - 1e-9) % 2 == 0 ? 1 : 2);
    return place::sampling_unit(moved, time_s, 6);
  };
  const double expected = 6 * 0.04 * (1.5 + 2 * 0.5);
  for (const double rate_hz : {10.0, 25.0, 50.0})
    EXPECT_NEAR(unit(times(static_cast<std::size_t>(20 * rate_hz) + 1, rate_hz)), expected, 1e-9) << rate_hz;
  std::vector<double> uneven{0};
  for (int i = 0; i < 20; ++i)
    for (int k = 1; k <= (i % 3 == 0 ? 50 : 10); ++k) uneven.push_back(i + k / (i % 3 == 0 ? 50.0 : 10.0));
  EXPECT_NEAR(unit(uneven), expected, 1e-9);
}

TEST(SamplingUnit, RefusesTooFewFramesAndNoN) {
  EXPECT_THROW(place::sampling_unit({}, {}, 3), std::invalid_argument);
  EXPECT_THROW(place::sampling_unit(std::vector<double>{0}, times(1), 3), std::invalid_argument);
  EXPECT_THROW(place::sampling_unit(std::vector<double>{0, 1}, times(3), 3), std::invalid_argument);
  EXPECT_THROW(place::sampling_unit(std::vector<double>{0, 1}, times(2), 0), std::invalid_argument);
  EXPECT_THROW(place::sampling_unit(std::vector<double>{0, 1}, times(2), std::nan("")),
               std::invalid_argument);
}

TEST(Resample, WorkedExample) {
  // Travelled: 0, 0.5, 1.25, 1.75, 2, 3.5. Nearest to 1: 1.25. To 2: 2. To 3: 3.5 (2 is a whole unit away).
  EXPECT_THAT(place::resample(std::vector<double>{0, 0.5, 0.75, 0.5, 0.25, 1.5}, 1), ElementsAre(0, 2, 4, 5));
  // Travelled: 0, 0.75, 1.5: 1 lies nearer to 0.75.
  EXPECT_THAT(place::resample(std::vector<double>{0, 0.75, 0.75}, 1), ElementsAre(0, 1));
}

TEST(Resample, ASteadyWalkIsSampledEvenly) {
  EXPECT_EQ(place::resample(std::vector<double>(101, 0.25), 1), place::every_kth(101, 4));
}

TEST(Resample, StandingAddsNoKeyframe) {
  std::vector<double> walk(41, 0.25);
  const std::size_t keyframes = place::resample(walk, 1).size();
  walk.insert(walk.begin() + 20, 1000, 0.0);
  EXPECT_EQ(place::resample(walk, 1).size(), keyframes);
  EXPECT_THAT(place::resample(std::vector<double>(100, 0.0), 1), ElementsAre(0));
}

TEST(Resample, AJumpOverSeveralUnitsAddsNoCopies) {
  EXPECT_THAT(place::resample(std::vector<double>{0, 5, 5}, 1), ElementsAre(0, 1, 2));
  // Travelled 0, 0.875, 5.875: 0.875 is nearest to 1, 5.875 to 5.
  EXPECT_THAT(place::resample(std::vector<double>{0, 0.875, 5}, 1), ElementsAre(0, 1, 2));
}

TEST(Resample, AFrameStandsForItsNearestUnitsOnly) {
  // Travelled 0, 1.4375, 2.625, 3: the second is nearest to 1 and to 2, the last to 3, the third to none.
  EXPECT_THAT(place::resample(std::vector<double>{0, 1.4375, 1.1875, 0.375}, 1), ElementsAre(0, 1, 3));
}

TEST(Resample, EqualsTheDefinition) {
  vo::Rng rng(1);
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    std::vector<double> displacement(1 + rng.index(60));
    // Sixteenths add up without rounding; steps are from a fraction of the unit to several.
    const double largest = std::exp2(rng.uniform(-2, 2));
    for (double& step : displacement) step = std::floor(rng.uniform(0, 16 * largest)) / 16;
    EXPECT_EQ(place::resample(displacement, 1), nearest_frames(displacement, 1));
  }
}

TEST(Resample, KeepsKeyframesAUnitApart) {
  vo::Rng rng(2);
  std::vector<double> displacement(2000), travelled(2000);
  for (std::size_t i = 1; i < displacement.size(); ++i) {
    displacement[i] = rng.uniform(0, 0.3);
    travelled[i] = travelled[i - 1] + displacement[i];
  }
  const auto keyframes = place::resample(displacement, 1.7);
  for (std::size_t k = 1; k < keyframes.size(); ++k) {
    // Each is within half the longest step of its multiple of the unit.
    EXPECT_NEAR(travelled[keyframes[k]], 1.7 * static_cast<double>(k), 0.15 + 1e-9);
  }
  EXPECT_EQ(keyframes.size(), 1 + static_cast<std::size_t>(travelled.back() / 1.7));
}

TEST(Resample, BeginsAnewWhereTold) {
  const std::vector<double> walk(41, 0.25);
  // Frame 18 lies half a unit after a keyframe.
  EXPECT_THAT(place::resample(walk, 1, std::vector<std::size_t>{18, 20}),
              ElementsAre(0, 4, 8, 12, 16, 18, 20, 24, 28, 32, 36, 40));
  EXPECT_EQ(place::resample(walk, 1, std::vector<std::size_t>{0}), place::resample(walk, 1));
  EXPECT_THROW(place::resample(walk, 1, std::vector<std::size_t>{41}), std::invalid_argument);
  EXPECT_THROW(place::resample(walk, 1, std::vector<std::size_t>{20, 18}), std::invalid_argument);
}

TEST(Resample, OfNoFrameAndOfOne) {
  EXPECT_THAT(place::resample({}, 1), IsEmpty());
  EXPECT_THAT(place::resample(std::vector<double>{7}, 1), ElementsAre(0));
  EXPECT_THROW(place::resample(std::vector<double>{0, 1}, 0), std::invalid_argument);
  EXPECT_THROW(place::resample(std::vector<double>{0, 1}, std::nan("")), std::invalid_argument);
}

TEST(EveryKth, CountsFromTheFirst) {
  EXPECT_THAT(place::every_kth(7, 3), ElementsAre(0, 3, 6));
  EXPECT_THAT(place::every_kth(6, 3), ElementsAre(0, 3));
  EXPECT_THAT(place::every_kth(3, 1), ElementsAre(0, 1, 2));
  EXPECT_THAT(place::every_kth(2, 9), ElementsAre(0));
  EXPECT_THAT(place::every_kth(0, 2), IsEmpty());
  EXPECT_THROW(place::every_kth(5, 0), std::invalid_argument);
}

}  // namespace
