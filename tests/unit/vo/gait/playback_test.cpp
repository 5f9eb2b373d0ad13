#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/gait/playback.hpp>

namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kShown_hz = 30, kSteps_hz = 1.8;

struct Recording {
  std::vector<vo::FrameMotion> motion;
  std::vector<double> time_s;
};

/// Half a minute at 30 frames a second of a walker of 1.8 steps a second, `speed` times as fast as it was: a
/// bounce of 4 pixels, and a picture that grows by 15 % a second of the walker's.
Recording shown(double speed, double growth_per_s = 0.15, double bounce_px = 4, std::uint64_t seed = 1) {
  const double frame_s = speed / kShown_hz;  // of the walker's time
  vo::Rng rng(seed);
  Recording shown;
  for (int i = 0; i < 900; ++i) {
    const double phase = 2 * std::numbers::pi * kSteps_hz * frame_s;
    const double down_px = bounce_px * (std::sin(phase * (i - 1)) - std::sin(phase * i));
    shown.time_s.push_back(i / kShown_hz);
    shown.motion.push_back({.matches = 200,
                            .orientation_deg = 0.02 * rng.normal(),
                            .shift_px = 0.05 * rng.normal(),
                            .picture = vo::PictureMotion{.down_px = down_px + 0.05 * rng.normal(),
                                                         .growth = growth_per_s * frame_s},
                            .turn = vo::Turn{}});
  }
  return shown;
}

std::optional<double> impossible(const Recording& recording) {
  return vo::impossible_cadence_hz(recording.motion, recording.time_s);
}

TEST(ImpossibleCadence, IsNoneOfAWalkByItsOwnClock) {
  for (const double speed : {0.7, 1.0, 1.5, 1.9}) EXPECT_FALSE(impossible(shown(speed))) << speed;
}

TEST(ImpossibleCadence, IsThatOfSlowMotion) {
  for (const double times : {3.0, 4.0, 6.0, 8.0}) {
    const auto hz = impossible(shown(1 / times));
    ASSERT_TRUE(hz) << times;
    EXPECT_NEAR(*hz, kSteps_hz / times, 0.1 * kSteps_hz / times);
  }
}

TEST(ImpossibleCadence, IsThatOfATimeLapse) {
  for (const double times : {3.0, 3.5, 4.0}) {
    const auto hz = impossible(shown(times));
    ASSERT_TRUE(hz) << times;
    // A step is 4 to 6 frames, and good to one.
    const double frames = kShown_hz / (kSteps_hz * times);
    EXPECT_NEAR(kShown_hz / *hz, frames, 1) << times;
  }
}

TEST(ImpossibleCadence, IsNoneOfACameraShakenOnTheSpot) {
  for (const double times : {1.0 / 4, 4.0}) EXPECT_FALSE(impossible(shown(times, 0.0))) << times;
}

TEST(ImpossibleCadence, IsNoneWhereNothingBounces) {
  for (const double speed : {0.125, 0.25, 1.0, 4.0}) EXPECT_FALSE(impossible(shown(speed, 0.15, 0))) << speed;
  Recording noise = shown(1);
  vo::Rng rng(2);
  for (vo::FrameMotion& motion : noise.motion) motion.picture->down_px = rng.normal();
  EXPECT_FALSE(impossible(noise));
  for (vo::FrameMotion& motion : noise.motion) motion = {};  // nothing was tracked
  EXPECT_FALSE(impossible(noise));
}

TEST(ImpossibleCadence, IsNoneOfAlmostNothing) {
  EXPECT_FALSE(vo::impossible_cadence_hz({}, {}));
  const Recording brief = shown(0.25);
  for (const std::size_t frames : {1U, 2U, 3U, 10U}) {
    EXPECT_FALSE(vo::impossible_cadence_hz(std::span(brief.motion).first(frames),
                                           std::span(brief.time_s).first(frames)))
        << frames;
  }
  EXPECT_THROW(vo::impossible_cadence_hz(brief.motion, {}), std::invalid_argument);
}

TEST(ImpossibleCadence, IsSaidWithWhatToDo) {
  EXPECT_THAT(vo::impossible_cadence_text(0.451),
              AllOf(HasSubstr("about 0.45 steps"), HasSubstr("slow motion"), HasSubstr("--frame-rate-hz")));
  EXPECT_THAT(vo::impossible_cadence_text(6.25),
              AllOf(HasSubstr("about 6.2 steps"), HasSubstr("time lapse")));
}

}  // namespace
