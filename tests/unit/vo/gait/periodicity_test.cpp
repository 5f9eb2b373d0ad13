#include "support/gait_signals.hpp"

#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/lowpass.hpp>
#include <vo/gait/periodicity.hpp>

namespace {

using test_support::GaitSignal;
using testing::IsEmpty;

TEST(StridePeriodicity, OfASquareWaveByHand) {
  // At 10 frames a second, 5 up and 5 down: a stride of 1 s. A stride later all is as it was, a step later
  // its opposite: (1 - -1) / 2. The power is that of a sinusoid of amplitude sqrt(2).
  std::vector<double> wave(100);
  for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = i / 5 % 2 == 0 ? 1 : -1;
  const auto windows = vo::stride_periodicity(wave, 10);
  ASSERT_EQ(windows.size(), 50U);  // every second frame
  for (const vo::Periodicity& window : windows) {
    // Half the stride is 5 frames, so no interpolation blurs it; the other is rounding.
    EXPECT_NEAR(window.strength, 1, 1e-12);
    EXPECT_DOUBLE_EQ(window.step_s, 0.5);
    EXPECT_NEAR(window.amplitude, std::sqrt(2.0), 1e-12);
    EXPECT_TRUE(window.gait);
  }
  EXPECT_EQ(windows[7].frame, 14U);
}

TEST(StridePeriodicity, FindsTheCadenceFromAStrollToARun) {
  for (const double step_hz : {1.2, 1.5, 1.9, 2.4, 3.0, 3.5}) {
    const GaitSignal walk = GaitSignal().walk(static_cast<int>(20 * step_hz), step_hz, 1, 0.2);
    const auto windows = vo::stride_periodicity(vo::lowpass_zero_phase(walk.deg(), 25), 25);
    for (const vo::Periodicity& window : windows) {
      EXPECT_TRUE(window.gait) << step_hz;
      // A stride is a whole number of frames, and noise may move it by one more.
      EXPECT_NEAR(2 * window.step_s, 2 / step_hz, 1.5 / 25) << step_hz;
    }
  }
}

TEST(StridePeriodicity, DoesNotKnowTheSizeOfTheSignal) {
  GaitSignal walk = GaitSignal().walk(40, 1.9, 1, 0.1);
  auto signal = walk.deg();
  const auto windows = vo::stride_periodicity(signal, 25);
  for (double& value : signal) value *= -1024;  // exact
  const auto larger = vo::stride_periodicity(signal, 25);
  ASSERT_EQ(larger.size(), windows.size());
  for (std::size_t i = 0; i < windows.size(); ++i) {
    EXPECT_EQ(larger[i].strength, windows[i].strength);
    EXPECT_EQ(larger[i].amplitude, 1024 * windows[i].amplitude);
  }
}

TEST(StridePeriodicity, SeesNoGaitInNoiseBreathingOrNothing) {
  const auto none_in = [](const GaitSignal& signal) {
    const auto windows = vo::stride_periodicity(vo::lowpass_zero_phase(signal.deg(), 25), 25);
    EXPECT_FALSE(windows.empty());
    for (const vo::Periodicity& window : windows) EXPECT_FALSE(window.gait) << window.frame;
    EXPECT_FALSE(vo::gait_amplitude(windows).has_value());
  };
  // One chance hit is to be expected in five hours; these are ten minutes.
  for (std::uint64_t seed = 0; seed < 10; ++seed) none_in(GaitSignal(seed).stand(60, 0, 1));
  none_in(GaitSignal().stand(60, 1, 0.05));
  none_in(GaitSignal().stand(60, 0, 0));
}

TEST(StridePeriodicity, OfShortSignals) {
  EXPECT_THAT(vo::stride_periodicity({}, 25), IsEmpty());
  const auto one = vo::stride_periodicity(std::vector<double>{1}, 25);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_FALSE(one[0].gait);
  EXPECT_EQ(one[0].step_s, 0);
  // Two strides and a half fit twice into no window, but in themselves they do.
  const GaitSignal walk = GaitSignal().walk(5, 2, 1);
  const auto windows = vo::stride_periodicity(walk.deg(), 25);
  EXPECT_TRUE(windows.front().gait);
  EXPECT_NEAR(windows.front().step_s, 0.5, 0.021);  // to a frame's half
}

TEST(StridePeriodicity, RefusesWhatMakesNoSense) {
  const std::vector<double> signal(100, 0.0);
  EXPECT_THROW(vo::stride_periodicity(signal, 0), std::invalid_argument);
  EXPECT_THROW(vo::stride_periodicity(signal, 25, {.window_s = 0}), std::invalid_argument);
  EXPECT_THROW(vo::stride_periodicity(signal, 25, {.hop_s = -1}), std::invalid_argument);
  EXPECT_THROW(vo::stride_periodicity(signal, 25, {.min_step_hz = 4}), std::invalid_argument);
}

TEST(GaitAmplitude, IsTheMedianOfPower) {
  // Powers 1, 1, 4, 9 of gait, 15 in all: half of it, 7.5, is reached in the window of amplitude 3.
  const auto window = [](double amplitude, bool gait) {
    vo::Periodicity result;
    result.amplitude = amplitude;
    result.gait = gait;
    return result;
  };
  EXPECT_EQ(vo::gait_amplitude(std::vector{window(3, true), window(1, true), window(2, true), window(1, true),
                                           window(100, false)}),
            3);
  EXPECT_FALSE(vo::gait_amplitude(std::vector{window(100, false)}).has_value());
  EXPECT_FALSE(vo::gait_amplitude({}).has_value());
}

TEST(StridePeriodicity, IsNotLedAstrayByAFewWildValues) {
  GaitSignal walk = GaitSignal().walk(40, 1.9, 1, 0.1);
  auto signal = walk.deg();
  for (const std::size_t i : {200U, 201U, 202U, 300U}) signal[i] = 30;
  for (const vo::Periodicity& window : vo::stride_periodicity(signal, 25)) {
    EXPECT_TRUE(window.gait) << window.frame;
    // The wave with its harmonic and noise has amplitude sqrt(1.06); 4 of 125 values cut off at some 2.1 add
    // 0.28 to its square. As they were, they would make it 7.7.
    EXPECT_NEAR(window.amplitude, 1, 0.16) << window.frame;
  }
}

TEST(LocalGaitAmplitude, IsTheMedianOfTheWindowsThatCoverAFrame) {
  std::vector<vo::Periodicity> windows(4);
  for (std::size_t i = 0; i < 4; ++i) {
    windows[i].frame = 2 * i;
    windows[i].reach = 3;
    windows[i].amplitude = static_cast<double>(10 - i);
    windows[i].gait = i != 1;
  }
  // Windows 0, 2, 3 of gait (10, 8, 7) reach over frames 0-3, 1-7, 3-9; of two, the median is their mean.
  EXPECT_THAT(vo::local_gait_amplitude(windows, 11),
              testing::ElementsAre(10, 9, 9, 8, 7.5, 7.5, 7.5, 7.5, 7, 7, 0));
  EXPECT_THAT(vo::local_gait_amplitude({}, 2), testing::ElementsAre(0, 0));
}

TEST(NearestWindow, IsByTheMiddle) {
  std::vector<vo::Periodicity> windows(3);
  for (std::size_t i = 0; i < 3; ++i) windows[i].frame = 5 * i;
  const auto frame_of = [&](std::size_t frame) { return vo::nearest_window(windows, frame).frame; };
  EXPECT_EQ(frame_of(2), 0U);
  EXPECT_EQ(frame_of(3), 5U);
  EXPECT_EQ(frame_of(7), 5U);
  EXPECT_EQ(frame_of(100), 10U);
  EXPECT_THROW(vo::nearest_window({}, 0), std::invalid_argument);
}

TEST(SinusoidAmplitude, IsByHandAndCutOffAtTheEnds) {
  const std::vector<double> signal{3, 0, 0, 1, 1};
  EXPECT_DOUBLE_EQ(vo::sinusoid_amplitude(signal, 2, 1), std::sqrt(2.0 / 3));
  EXPECT_DOUBLE_EQ(vo::sinusoid_amplitude(signal, 0, 1), 3);
  EXPECT_DOUBLE_EQ(vo::sinusoid_amplitude(signal, 4, 1), std::sqrt(2.0));
}

}  // namespace
