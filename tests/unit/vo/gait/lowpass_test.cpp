#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/gait/lowpass.hpp>

namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;

std::vector<double> sine(std::size_t frames, double rate_hz, double hz) {
  std::vector<double> values(frames);
  for (std::size_t i = 0; i < frames; ++i)
    values[i] = std::sin(2 * kPi * hz * static_cast<double>(i) / rate_hz);
  return values;
}

/// Power gain of an ideal Butterworth filter behind the bilinear transform.
double analytic_power_gain(double hz, double rate_hz, int order, double cutoff_hz) {
  const double warped = std::tan(kPi * hz / rate_hz) / std::tan(kPi * cutoff_hz / rate_hz);
  return 1 / (1 + std::pow(warped, 2 * order));
}

TEST(BridgeGaps, DrawsLinesBetweenWhatIsReliable) {
  const std::vector<double> values{9, 1, 9, 9, 9, 5, 6, 9};
  EXPECT_THAT(vo::bridge_gaps(values, {false, true, false, false, false, true, true, false}),
              ElementsAre(1, 1, 2, 3, 4, 5, 6, 6));
  EXPECT_EQ(vo::bridge_gaps(values, std::vector<bool>(8, true)), values);
  EXPECT_THAT(vo::bridge_gaps(values, std::vector<bool>(8, false)), Each(0));
  EXPECT_THAT(vo::bridge_gaps({}, {}), IsEmpty());
  EXPECT_THROW(vo::bridge_gaps(values, {true}), std::invalid_argument);
}

TEST(Lowpass, OfOrderOneByHand) {
  // Rate four times the cut-off: tan(pi / 4) = 1, so y = (x + x before) / 2.
  vo::Lowpass filter(16, {.order = 1, .cutoff_hz = 4});
  EXPECT_NEAR(filter.push(0), 0, 1e-15);
  EXPECT_NEAR(filter.push(2), 1, 1e-15);
  EXPECT_NEAR(filter.push(4), 3, 1e-15);
  EXPECT_NEAR(filter.push(0), 2, 1e-15);
}

TEST(Lowpass, HasTheGainOfButterworth) {
  for (int order = 1; order <= 8; ++order) {
    // The response to an impulse, which does not arrive first, so that the filter starts from rest.
    vo::Lowpass filter(25, {.order = order});
    filter.push(0);
    std::vector<double> response;
    for (int i = 0; i < 2000; ++i) response.push_back(filter.push(i == 0 ? 1 : 0));
    for (const double hz : {0.0, 0.5, 1.0, 2.0, 3.9, 4.0, 5.0, 8.0, 12.0}) {
      std::complex<double> gain = 0;
      for (std::size_t i = 0; i < response.size(); ++i)
        gain += response[i] * std::polar(1.0, -2 * kPi * hz * static_cast<double>(i) / 25);
      // Rounding of 2000 terms; the response has died away by then.
      EXPECT_NEAR(std::norm(gain), analytic_power_gain(hz, 25, order, 4), 1e-9) << order << " at " << hz;
    }
  }
}

TEST(Lowpass, OfAConstantIsItFromTheFirstValueOn) {
  for (int order = 1; order <= 8; ++order) {
    vo::Lowpass filter(30, {.order = order});
    for (int i = 0; i < 100; ++i) EXPECT_NEAR(filter.push(-3.5), -3.5, 1e-12) << order;  // rounding
  }
}

TEST(Lowpass, NamesWhatIsWrong) {
  const auto message = [](double rate_hz, const vo::LowpassOptions& options) -> std::string {
    try {
      vo::Lowpass filter(rate_hz, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message(8, {}), HasSubstr("frame rate: is 8 Hz; above 8 Hz expected"));
  EXPECT_EQ(message(8.01, {}), "accepted");
  EXPECT_THAT(message(25, {.order = 0}), HasSubstr("order: is 0; 1 to 8 expected"));
  EXPECT_THAT(message(25, {.order = 9}), HasSubstr("order"));
  EXPECT_THAT(message(25, {.cutoff_hz = 0}), HasSubstr("above 0 Hz expected"));
  EXPECT_THAT(message(std::nan(""), {}), HasSubstr("frame rate"));
}

TEST(LowpassZeroPhase, SquaresTheGainAndKeepsThePhase) {
  for (const double hz : {0.5, 1.0, 3.0, 4.0, 6.0}) {
    for (const int order : {1, 2, 3, 4, 8}) {
      const auto in = sine(1000, 25, hz);
      const auto out = vo::lowpass_zero_phase(in, 25, {.order = order});
      const double gain = analytic_power_gain(hz, 25, order, 4);
      ASSERT_EQ(out.size(), in.size());
      // In the middle, where what the ends ring has died away: the slowest pole of order 8 loses a factor of
      // e every 5 frames.
      for (std::size_t i = 300; i < 700; ++i)
        EXPECT_NEAR(out[i], gain * in[i], 1e-9) << hz << " Hz, " << order;
    }
  }
}

TEST(LowpassZeroPhase, IsTheSameBackwards) {
  vo::Rng rng(3);
  std::vector<double> signal(200);
  for (double& value : signal) value = rng.normal();
  auto forwards = vo::lowpass_zero_phase(signal, 25);
  std::ranges::reverse(signal);
  auto backwards = vo::lowpass_zero_phase(signal, 25);
  std::ranges::reverse(backwards);
  // The two passes change places, which only the ends see; those by less than the noise they stand in.
  for (std::size_t i = 40; i < 160; ++i) EXPECT_NEAR(forwards[i], backwards[i], 1e-9);
}

TEST(LowpassZeroPhase, KeepsLinesToTheirEnds) {
  // An odd reflection continues a line, and a filter of zero phase keeps it.
  std::vector<double> line(120);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = 5 - 0.25 * static_cast<double>(i);
  const auto out = vo::lowpass_zero_phase(line, 25);
  // The line's own beginning, three periods of 4 Hz away, still rings by e^-13 of its slope.
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(out[i], line[i], 1e-5) << i;
}

TEST(LowpassZeroPhase, OfVeryShortSignals) {
  EXPECT_THAT(vo::lowpass_zero_phase({}, 25), IsEmpty());
  EXPECT_THAT(vo::lowpass_zero_phase(std::vector<double>{7}, 25), ElementsAre(testing::DoubleNear(7, 1e-12)));
  const auto two = vo::lowpass_zero_phase(std::vector<double>{1, 3}, 25);
  ASSERT_EQ(two.size(), 2U);
  for (const double value : two) EXPECT_TRUE(value >= 1 && value <= 3) << value;
  for (const double value : vo::lowpass_zero_phase(std::vector<double>(50, 2.0), 25))
    EXPECT_NEAR(value, 2, 1e-12);
  EXPECT_THROW(vo::lowpass_zero_phase({}, 8), std::invalid_argument);
}

TEST(WithoutDrift, KeepsWhatALowpassTakes) {
  // Strides at 1 Hz upon a turn: the line goes, and of the sinusoid goes what order 2 at 0.5 Hz, twice, lets
  // through.
  auto signal = sine(1000, 25, 1);
  const double gain = 1 - analytic_power_gain(1, 25, 2, 0.5);
  const auto strides = signal;
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] += 0.1 * static_cast<double>(i);
  const auto rest = vo::without_drift(signal, 25);
  // In the middle, where the ends' ringing has died away: the filter loses a factor of e every 12 frames.
  for (std::size_t i = 400; i < 600; ++i) EXPECT_NEAR(rest[i], gain * strides[i], 1e-9);
  for (const double value : vo::without_drift(std::vector<double>(50, 7.0), 25)) EXPECT_NEAR(value, 0, 1e-12);
  EXPECT_THAT(vo::without_drift({}, 25), IsEmpty());
}

}  // namespace
