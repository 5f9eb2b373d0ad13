#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <simulate/simulator.hpp>
#include <vo/motion/walk_motion.hpp>

/// SSS Fig. 9 on a walk whose truth is known: sources of motion fail, the hybrid goes on.
namespace {

/// A simulated walk, drawn as it is read.
class DrawnWalk final : public vo::FrameSource {
 public:
  explicit DrawnWalk(const simulate::WalkSimulator& walk) : walk_(walk) {}

  std::optional<vo::Frame> next() override {
    if (frame_ == walk_.frame_count()) return std::nullopt;
    const int i = frame_++;
    return vo::Frame{.index = i, .time_s = walk_.truth(i).time_s, .image = walk_.render(i)};
  }

 private:
  const simulate::WalkSimulator& walk_;
  int frame_ = 0;
};

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// Root mean square error of the length of each metre walked, after the whole length was made right: what is
/// left is how wrong the speed is.
double speed_error(const std::vector<double>& displacement, const std::vector<double>& true_m) {
  const double scale = sum(true_m) / sum(displacement);
  double square = 0, metres = 0, walked_m = 0, said_m = 0;
  for (std::size_t i = 0; i < true_m.size(); ++i) {
    walked_m += true_m[i];
    said_m += scale * displacement[i];
    if (walked_m < 1) continue;
    square += (said_m / walked_m - 1) * (said_m / walked_m - 1);
    ++metres;
    walked_m = said_m = 0;
  }
  return std::sqrt(square / metres);
}

class Failures : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    simulate::Options options;
    options.length_m = 55;
    options.seed = 11;
    options.gait_seed = 5;
    options.speed = simulate::Speed::kSlowFast;
    options.failures = 4;
    options.failure_s = 3.5;
    const simulate::WalkSimulator simulator(options);
    for (int i = 0; i < simulator.frame_count(); ++i) {
      const double here_m = simulator.truth(i).distance_m;
      true_m.push_back(i == 0 ? 0 : here_m - simulator.truth(i - 1).distance_m);
    }
    failures = simulator.failures();
    vo::WalkOptions reading;
    reading.preview_width_px = 0;
    vo::keep_for(vo::MotionSource::kHybrid, reading);
    DrawnWalk source(simulator);
    walk = vo::read_walk(source, "a walk with failures", reading);
    const int steps = simulator.truth(simulator.frame_count() - 1).steps;
    settings.pedestrian.step_length.length_m = sum(true_m) / steps;  // as measured beforehand
    hybrid = vo::walk_motion(walk, vo::MotionSource::kHybrid, settings);
  }

  static bool failing(std::size_t frame) {
    return simulate::failure_at(failures, walk.time_s[frame]).has_value();
  }

  static inline vo::Walk walk;
  static inline vo::WalkMotionOptions settings;
  static inline vo::WalkMotion hybrid;
  static inline std::vector<double> true_m;
  static inline std::vector<simulate::Failure> failures;
};

TEST_F(Failures, TheHybridKeepsTheLengthThatVisualOdometryLoses) {
  ASSERT_TRUE(hybrid.metric);
  const double true_length_m = sum(true_m);
  EXPECT_NEAR(sum(vo::displacements(hybrid)), true_length_m, 0.05 * true_length_m);

  // Visual odometry alone, at best: all its segments in metres, and still nothing where it is lost.
  double tracked_m = 0;
  for (std::size_t i = 0; i < walk.frames(); ++i) tracked_m += walk.track->frames[i].valid ? true_m[i] : 0;
  EXPECT_LT(tracked_m, 0.75 * true_length_m);
}

TEST_F(Failures, TheHybridsSpeedIsBetterThanEitherSources) {
  const double of_hybrid = speed_error(vo::displacements(hybrid), true_m);
  const auto error_of = [&](vo::MotionSource source) {
    return speed_error(vo::displacements(vo::walk_motion(walk, source, settings)), true_m);
  };
  const double of_errors = error_of(vo::MotionSource::kSad);
  const double of_track = error_of(vo::MotionSource::kVisualOdometry);
  RecordProperty("speed_error_hybrid", std::to_string(of_hybrid));
  RecordProperty("speed_error_sad", std::to_string(of_errors));
  RecordProperty("speed_error_vo", std::to_string(of_track));
  std::printf("speed error over a metre: hybrid %.3f, alignment error %.3f, visual odometry %.3f\n",
              of_hybrid, of_errors, of_track);
  EXPECT_LT(of_hybrid, of_errors);
  EXPECT_LT(of_hybrid, of_track);
}

TEST_F(Failures, WithoutStepsTheGroundKeepsTheUnit) {
  vo::Walk stepless = walk;
  stepless.tracked.clear();
  const vo::WalkMotion motion = vo::walk_motion(stepless, vo::MotionSource::kHybrid, settings);
  EXPECT_FALSE(motion.metric);
  // Metres to a unit over each quarter of the walk; in each a failure begins another unit of odometry's own.
  const std::vector<double> moved = vo::displacements(motion);
  std::vector<double> scales;
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    double true_way_m = 0, way = 0;
    for (std::size_t i = quarter * moved.size() / 4; i < (quarter + 1) * moved.size() / 4; ++i) {
      if (motion.frames[i].source != vo::DisplacementSource::kTrack) continue;
      true_way_m += true_m[i];
      way += moved[i];
    }
    if (way > 0) scales.push_back(true_way_m / way);
    std::printf("metres to a unit: %.3f\n", scales.empty() ? 0 : scales.back());
  }
  ASSERT_GE(scales.size(), 3U);
  const auto [least, most] = std::ranges::minmax(scales);
  // A height is good to 3 % where much ground is seen; a stretch between two failures here has some seconds.
  EXPECT_LT(most / least, 1.15);
}

TEST_F(Failures, TheHybridIsContinuous) {
  const double mean_m = sum(true_m) / static_cast<double>(walk.frames());
  for (std::size_t i = 1; i < walk.frames(); ++i) {
    // This walker never stands, and never moves at three times his mean speed.
    EXPECT_GT(hybrid.frames[i].value, 0) << i;
    EXPECT_LT(hybrid.frames[i].value, 3 * mean_m) << i;
    EXPECT_GT(hybrid.frames[i].sigma, 0) << i;
  }
}

TEST_F(Failures, EachFrameNamesItsSource) {
  std::size_t tracked = 0, others = 0;
  for (std::size_t i = 1; i < walk.frames(); ++i) {
    const bool by_track = hybrid.frames[i].source == vo::DisplacementSource::kTrack;
    if (walk.track->frames[i].valid && !failing(i)) tracked += by_track ? 1 : 0;
    if (failing(i)) others += by_track ? 0 : 1;
    EXPECT_TRUE(!by_track || walk.track->frames[i].valid) << i;
  }
  // Fourteen of the walk's seconds are failures; the track may last into their first frames, where a picture
  // still goes on from the one before.
  EXPECT_GT(others, 0.8 * 14 * 25);
  EXPECT_GT(tracked, 0.4 * static_cast<double>(walk.frames()));
}

}  // namespace
