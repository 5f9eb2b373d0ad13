#include "support/synthetic_walk.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/odometry.hpp>

namespace {

using test_support::places;
using test_support::TemporaryFolder;
using test_support::Wall;
using testing::Each;
using testing::ElementsAreArray;
using testing::IsEmpty;
using testing::SizeIs;

/// Writes the views at the given places as images.
void write_walk(const std::filesystem::path& folder, const Wall& wall, const std::vector<double>& place_px) {
  for (std::size_t i = 0; i < place_px.size(); ++i) {
    auto pixels = wall.view(place_px[i]);
    const cv::Mat image(Wall::kHeight, Wall::kWidth, CV_8UC1, pixels.data());
    ASSERT_TRUE(cv::imwrite((folder / (std::to_string(i) + ".png")).string(), image));
  }
}

double mean(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  return std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(begin),
                         values.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
         static_cast<double>(end - begin);
}

TEST(ReadWalk, KeepsTimesThumbnailsAndPreviews) {
  const TemporaryFolder folder;
  const Wall wall(100, 1);
  const auto place_px = places(0, std::vector<double>(20, 2.5));
  write_walk(folder.path(), wall, place_px);
  const vo::Walk walk =
      vo::read_walk(folder.path().string(), {.frames = {.frame_rate_hz = 10}, .preview_width_px = 32});
  EXPECT_EQ(walk.source, folder.path().string());
  EXPECT_EQ(walk.frame_width_px, Wall::kWidth);
  EXPECT_EQ(walk.frame_height_px, Wall::kHeight);
  ASSERT_EQ(walk.frames(), 21U);
  ASSERT_EQ(walk.thumbnails.size(), 21U);
  ASSERT_THAT(walk.previews, SizeIs(21));
  EXPECT_THAT(walk.warnings, IsEmpty());
  for (std::size_t i = 0; i < 21; ++i) {
    EXPECT_DOUBLE_EQ(walk.time_s[i], static_cast<double>(i) / 10);
    // The images are as large as thumbnails and PNG is lossless.
    EXPECT_THAT(walk.thumbnails[i], ElementsAreArray(wall.view(place_px[i]))) << i;
    const cv::Mat preview = cv::imdecode(walk.previews[i], cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(preview.size(), cv::Size(32, 16));
  }
}

TEST(ReadWalk, KeepsNoPreviewWhereNoneIsAskedForAndNoneLargerThanTheFrame) {
  const TemporaryFolder folder;
  write_walk(folder.path(), Wall(10, 1), {0, 1});
  EXPECT_THAT(vo::read_walk(folder.path().string(), {.preview_width_px = 0}).previews, IsEmpty());
  const vo::Walk walk = vo::read_walk(folder.path().string(), {.preview_width_px = 160});
  EXPECT_EQ(cv::imdecode(walk.previews[0], cv::IMREAD_GRAYSCALE).cols, Wall::kWidth);
  EXPECT_THROW(vo::read_walk(folder.path().string(), {.preview_width_px = -1}), std::invalid_argument);
}

TEST(ReadWalk, KeepsWhatRecordersGive) {
  const TemporaryFolder folder;
  write_walk(folder.path(), Wall(10, 1), {0, 1, 2});
  vo::WalkOptions options;
  options.recorders = {[](const vo::Frame& frame) {
                         return std::vector<std::uint8_t>{static_cast<std::uint8_t>(frame.index)};
                       },
                       [](const vo::Frame&) { return std::vector<std::uint8_t>{}; }};
  const vo::Walk walk = vo::read_walk(folder.path().string(), options);
  ASSERT_THAT(walk.records, SizeIs(2));
  ASSERT_THAT(walk.records[0], SizeIs(walk.frames()));
  for (std::size_t i = 0; i < walk.frames(); ++i) EXPECT_THAT(walk.records[0][i], testing::ElementsAre(i));
  EXPECT_THAT(walk.records[1], testing::Each(IsEmpty()));
}

TEST(ReadWalk, RefusesASingleFrame) {
  const TemporaryFolder folder;
  write_walk(folder.path(), Wall(10, 1), {0});
  EXPECT_THROW_WITH(vo::read_walk(folder.path().string()), vo::Error,
                    folder.path().string() + ": has 1 frame; expected a walk of at least 2 frames");
  EXPECT_THROW_WITH(vo::read_walk((folder / "none").string()), vo::Error, "none: does not exist");
}

TEST(ReadWalk, StopsEarlyWithWhatItHas) {
  const TemporaryFolder folder;
  write_walk(folder.path(), Wall(100, 1), places(0, std::vector<double>(99, 1)));
  vo::set_thread_count(2);
  std::vector<std::int64_t> done;
  const vo::Walk walk = vo::read_walk(folder.path().string(), {}, [&](const vo::Progress& progress) {
    EXPECT_EQ(progress.total, 100);
    EXPECT_EQ(progress.stage, "reading " + folder.path().string());
    done.push_back(progress.done);
    return progress.done < 30;
  });
  vo::set_thread_count(0);
  EXPECT_TRUE(std::ranges::is_sorted(done));
  EXPECT_GE(walk.frames(), 30U);
  EXPECT_LT(walk.frames(), 100U);
  EXPECT_EQ(static_cast<std::size_t>(done.back()), walk.frames());
  EXPECT_EQ(walk.thumbnails.size(), walk.frames());
  EXPECT_EQ(walk.previews.size(), walk.frames());
}

TEST(ReadWalk, IsTheSameForAnyThreadCount) {
  const TemporaryFolder folder;
  write_walk(folder.path(), Wall(100, 1), places(0, std::vector<double>(30, 1)));
  vo::set_thread_count(1);
  const vo::Walk one = vo::read_walk(folder.path().string());
  vo::set_thread_count(4);
  const vo::Walk four = vo::read_walk(folder.path().string());
  vo::set_thread_count(0);
  EXPECT_EQ(one.time_s, four.time_s);
  EXPECT_EQ(one.thumbnails.pixels, four.thumbnails.pixels);
  EXPECT_EQ(one.previews, four.previews);
}

TEST(ReadWalk, SaysWhereTheClockJumps) {
  /// Frames at 10 Hz whose clock jumps at the 10th and the 20th.
  class Jumping final : public vo::FrameSource {
   public:
    std::optional<vo::Frame> next() override {
      if (index_ == 30) return std::nullopt;
      vo::Frame frame;
      frame.image = cv::Mat(20, 20, CV_8UC1, cv::Scalar(100));
      frame.time_s = index_ / 10.0;
      if (index_ >= 10) frame.time_s += 2;
      if (index_ >= 20) frame.time_s += 8;
      ++index_;
      return frame;
    }

   private:
    int index_ = 0;
  } frames;
  vo::WalkOptions options{.visual_odometry = true};
  const vo::Walk walk = vo::read_walk(frames, "walk.mp4", options);
  ASSERT_THAT(walk.gaps, SizeIs(2));
  EXPECT_EQ(walk.gaps[0].frame, 10U);
  EXPECT_NEAR(walk.gaps[0].length_s, 2.1, 1e-9);
  EXPECT_EQ(walk.gaps[1].frame, 20U);
  ASSERT_THAT(walk.warnings, SizeIs(2));
  EXPECT_EQ(
      walk.warnings[0],
      "walk.mp4: no frames for 8.1 s, from 3.90 s on (frame 19); what was walked in it is not known, and "
      "no sequence crosses it");
  EXPECT_EQ(
      walk.warnings[1],
      "walk.mp4: no frames for 2.1 s, from 0.90 s on (frame 9); what was walked in it is taken from the "
      "pace around it");
  EXPECT_FALSE(walk.track->frames[20].valid);
  EXPECT_EQ(walk.track->frames[20].loss, vo::TrackLoss::kGap);
}

TEST(VisualMotion, OfASteadyWalkIsASecondASecond) {
  const Wall wall(1000, 1);
  const auto motion = vo::visual_motion(wall.walk(places(0, std::vector<double>(599, 0.5))));
  ASSERT_THAT(motion.displacement, SizeIs(600));
  EXPECT_EQ(motion.displacement[0], 0);
  EXPECT_TRUE(motion.model.learned());
  EXPECT_THAT(motion.standing, Each(false));
  // The least over five separations lies below the mean, and one piece of wall has more contrast than
  // another; over 20 s that evens out to a few percent.
  EXPECT_NEAR(30 * mean(motion.displacement, 1, 600), 1, 0.1);
}

TEST(VisualMotion, FollowsTheSpeed) {
  std::vector<double> speed_px(300, 0.3);
  speed_px.insert(speed_px.end(), 300, 0.6);
  speed_px.insert(speed_px.end(), 300, 0.3);
  const Wall wall(600, 2);
  const auto motion = vo::visual_motion(wall.walk(places(0, speed_px)));
  EXPECT_THAT(motion.standing, Each(false));
  const double slow = mean(motion.displacement, 10, 290), fast = mean(motion.displacement, 310, 590);
  // The texture's contrast varies by some 10 percent between stretches of 100 px (12 random columns of 5).
  EXPECT_NEAR(fast / slow, 2, 0.3);
  EXPECT_NEAR(mean(motion.displacement, 610, 890) / slow, 1, 0.2);
}

TEST(VisualMotion, DoesNotMoveWhileTheWalkerStands) {
  std::vector<double> speed_px(200, 0.5);
  for (int i = 0; i < 150; ++i) speed_px.push_back(i % 2 == 0 ? 0.2 : -0.2);  // 5 s of sway
  speed_px.insert(speed_px.end(), 200, 0.5);
  const Wall wall(300, 3);
  const auto motion = vo::visual_motion(wall.walk(places(0, speed_px)));
  for (std::size_t i = 201; i <= 350; ++i) {
    EXPECT_TRUE(motion.standing[i]) << i;
    EXPECT_EQ(motion.displacement[i], 0) << i;
  }
  for (std::size_t i = 0; i < motion.standing.size(); ++i) {
    if (!motion.standing[i]) continue;
    // A walker who has just arrived or is about to leave has not yet left the view: views are alike for
    // some pixels, here at 1/2 pixel per frame.
    EXPECT_GE(i, 201U - 16);
    EXPECT_LE(i, 350U + 16);
  }
  EXPECT_GT(30 * mean(motion.displacement, 20, 180), 0.5);
  EXPECT_GT(30 * mean(motion.displacement, 380, 540), 0.5);
}

TEST(VisualMotion, OfTwoFramesIsOneStep) {
  const Wall wall(500, 1);
  const auto motion = vo::visual_motion(wall.walk(std::vector<double>{0, 300}));
  ASSERT_THAT(motion.displacement, SizeIs(2));
  EXPECT_EQ(motion.displacement[0], 0);
  EXPECT_NEAR(motion.displacement[1], 1.0 / 30, 1e-6);  // the model's table
}

TEST(VisualMotion, LearnsFromTheWalkBetweenStands) {
  // However long the stand, a second of walking is a second.
  const Wall wall(300, 3);
  for (const std::size_t stand : {150U, 3000U}) {
    std::vector<double> speed_px(200, 0.5);
    for (std::size_t i = 0; i < stand; ++i) speed_px.push_back(i % 2 == 0 ? 0.2 : -0.2);
    speed_px.insert(speed_px.end(), 200, 0.5);
    const auto motion = vo::visual_motion(wall.walk(places(0, speed_px)));
    // The walker has not left the view for 16 frames on either side of the stand.
    const double walked =
        mean(motion.displacement, 1, 201) + mean(motion.displacement, 201 + stand, 401 + stand);
    EXPECT_NEAR(30 * walked / 2, 1, 0.1) << stand;
    EXPECT_EQ(mean(motion.displacement, 201, 201 + stand), 0) << stand;
  }
}

TEST(VisualMotion, WalksOnOverAShortJumpOfTheClockAndStopsAtALongOne) {
  const Wall wall(1000, 1);
  for (const double jump_s : {0.5, 2.0, 5.0, 3600.0}) {
    vo::Walk walk = wall.walk(places(0, std::vector<double>(599, 0.5)));
    for (std::size_t i = 300; i < walk.frames(); ++i) walk.time_s[i] += jump_s;
    walk.gaps = vo::clock_gaps(walk.time_s);
    ASSERT_EQ(walk.gaps.size(), 1U);
    const auto motion = vo::visual_motion(walk);
    EXPECT_FALSE(motion.usable[300]);
    const double pace = 30 * (mean(motion.displacement, 270, 300) + mean(motion.displacement, 301, 331)) / 2;
    EXPECT_NEAR(motion.displacement[300], jump_s < 3 ? pace * walk.gaps[0].length_s : 0, 1e-9) << jump_s;
  }
}

TEST(VisualMotion, RefusesAWalkWithoutMotion) {
  const Wall wall(100, 1);
  EXPECT_THROW_WITH(vo::visual_motion(wall.walk(std::vector<double>(100, 7.0), "still.mp4")), vo::Error,
                    "still.mp4: shows no motion to learn from");
  vo::Walk black = wall.walk(places(0, std::vector<double>(99, 0.5)), "black.mp4");
  std::ranges::fill(black.thumbnails.pixels, std::uint8_t{0});
  EXPECT_THROW_WITH(vo::visual_motion(black), vo::Error, "black.mp4: shows no motion");
  EXPECT_THROW_WITH(vo::visual_motion(wall.walk(std::vector<double>{0}, "one.mp4")), vo::Error, "one.mp4");
}

TEST(VisualMotion, IsTheSameForAnyThreadCount) {
  const vo::Walk walk = Wall(300, 1).walk(places(0, std::vector<double>(199, 0.5)));
  vo::set_thread_count(1);
  const auto one = vo::visual_motion(walk);
  vo::set_thread_count(4);
  const auto four = vo::visual_motion(walk);
  vo::set_thread_count(0);
  EXPECT_EQ(one.displacement, four.displacement);
  EXPECT_EQ(one.standing, four.standing);
  EXPECT_EQ(one.model.error, four.model.error);
}

/// Ten seconds at 25 frames/s of a walk at 2 steps a second, straight on: the stride swings in one of the
/// signals.
vo::Walk tracked_walk(double orientation_deg, double shift_px, double rate_hz = 25) {
  vo::Walk walk;
  walk.source = "walk.mp4";
  for (int i = 0; i < 250; ++i) {
    const double time_s = i / rate_hz;
    const double swing = std::sin(2 * std::numbers::pi * time_s);  // a stride of two steps takes a second
    walk.time_s.push_back(time_s);
    vo::FrameMotion motion;
    if (i > 0) {
      motion.matches = 200;
      motion.orientation_deg = orientation_deg * swing;
      motion.shift_px = shift_px * swing;
      motion.turn = vo::Turn{};
      motion.picture = vo::PictureMotion{.growth = 0.25 / rate_hz};
    }
    walk.tracked.push_back(motion);
  }
  return walk;
}

TEST(PedestrianMotion, CountsStepsAndWalksThem) {
  vo::PedestrianMotionOptions options;
  options.step_length.length_m = 0.8;
  const vo::PedestrianMotion motion = vo::pedestrian_motion(tracked_walk(0.5, 0), options);
  EXPECT_EQ(motion.step_signal, vo::StepSignal::kOrientation);
  EXPECT_EQ(motion.detection.steps.size(), 20U);  // peaks at 0.25 s, 0.75 s, ...
  double walked_m = 0;
  for (const double moved_m : motion.displacement_m) walked_m += moved_m;
  EXPECT_NEAR(walked_m, 20 * 0.8, 1e-9);
  // Heading 0 is +y.
  EXPECT_NEAR(motion.trajectory.at_frame.back().pose.x_m, 0, 1e-9);
  EXPECT_NEAR(motion.trajectory.at_frame.back().pose.y_m, 20 * 0.8, 1e-9);
  ASSERT_EQ(motion.activity.size(), 10U);
  EXPECT_EQ(motion.activity[5].activity, vo::Activity::kWalking);
}

TEST(CalibratedStepLength, MakesAWalkAsLongAsItIs) {
  const vo::Walk walk = tracked_walk(0.5, 0);
  const std::optional<double> length_m = vo::calibrated_step_length_m(walk, 15);
  ASSERT_TRUE(length_m);
  EXPECT_NEAR(*length_m, 15.0 / 20, 1e-9);  // twenty steps
  vo::PedestrianMotionOptions options;
  options.step_length.length_m = *length_m;
  EXPECT_NEAR(vo::pedestrian_motion(walk, options).trajectory.at_frame.back().pose.y_m, 15, 1e-9);
  EXPECT_FALSE(vo::calibrated_step_length_m(tracked_walk(0, 0), 15));  // no steps
  EXPECT_THROW(vo::calibrated_step_length_m(walk, 0), std::invalid_argument);
}

TEST(PedestrianMotion, ReadsStepsFromTheShiftWhereTheHorizonIsSteady) {
  const vo::PedestrianMotion motion = vo::pedestrian_motion(tracked_walk(0, 3));
  EXPECT_EQ(motion.step_signal, vo::StepSignal::kShift);
  EXPECT_NEAR(static_cast<double>(motion.detection.steps.size()), 20, 1);  // taking drift out bends the ends
}

TEST(PedestrianMotion, ReadsStepsFromTheBounceWhereThereIsOne) {
  vo::Walk walk = tracked_walk(0.5, 3);
  for (std::size_t i = 1; i < walk.frames(); ++i) {
    // Up fastest as a foot lands, every half second; the roll is at its fastest a quarter second before.
    const double down_px = -2 * std::cos(4 * std::numbers::pi * walk.time_s[i]);
    walk.tracked[i].picture =
        vo::PictureMotion{.right_px = 0, .down_px = down_px, .growth = 0.01, .roll_rad = 0};
  }
  const vo::PedestrianMotion motion = vo::pedestrian_motion(walk);
  EXPECT_EQ(motion.step_signal, vo::StepSignal::kBounce);
  ASSERT_EQ(motion.detection.steps.size(), 19U);  // the recording ends a frame before another
  EXPECT_EQ(motion.detection.steps[0].leg, vo::Leg::kLeft);
  EXPECT_NEAR(motion.detection.steps[0].time_s, 0.5, 0.05);
  EXPECT_EQ(motion.activity[5].activity, vo::Activity::kWalking);

  vo::PedestrianMotionOptions options;
  options.steps.signal = vo::StepSignal::kOrientation;
  EXPECT_EQ(vo::pedestrian_motion(walk, options).step_signal, vo::StepSignal::kOrientation);
  options.steps.signal = vo::StepSignal::kShift;
  EXPECT_EQ(vo::pedestrian_motion(walk, options).step_signal, vo::StepSignal::kShift);
  // A threshold in degrees is one of the orientation.
  options = {};
  options.steps.detection.delta_min = 0.1;
  EXPECT_EQ(vo::pedestrian_motion(walk, options).step_signal, vo::StepSignal::kOrientation);
}

TEST(PedestrianMotion, OfAStillSignalHasNoSteps) {
  const vo::PedestrianMotion motion = vo::pedestrian_motion(tracked_walk(0, 0));
  EXPECT_EQ(motion.step_signal, vo::StepSignal::kOrientation);
  EXPECT_TRUE(motion.detection.steps.empty());
  EXPECT_THAT(motion.displacement_m, testing::Each(0));
  EXPECT_EQ(motion.trajectory.at_frame.size(), 250U);
}

/// The walk of `tracked_walk` with a bounce, as a camera sees it whose frames come at these times.
vo::Walk bouncing_walk(const std::vector<double>& time_s, std::size_t window = 3) {
  vo::Walk walk;
  walk.source = "walk.mp4";
  walk.time_s = time_s;
  walk.gaps = vo::clock_gaps(time_s);
  // Where the picture is, by the walker's own clock: the change over a window is the difference at its ends.
  const auto down_px = [](double s) { return -4 * std::sin(4 * std::numbers::pi * s); };
  const auto roll_deg = [](double s) { return -2 * std::cos(2 * std::numbers::pi * s); };
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    vo::FrameMotion motion{.matches = 200, .window = static_cast<int>(std::min(i, window))};
    if (i > 0) {
      const double frames = motion.window, from_s = time_s[i - std::min(i, window)];
      const double seconds = time_s[i] - from_s;
      motion.orientation_deg = (roll_deg(time_s[i]) - roll_deg(from_s)) / frames;
      motion.shift_px = 0.0;
      motion.turn = vo::Turn{.turn_rad = 0.05 * seconds / frames};
      motion.picture = vo::PictureMotion{.down_px = (down_px(time_s[i]) - down_px(from_s)) / frames,
                                         .growth = 0.25 * seconds / frames};
    }
    walk.tracked.push_back(motion);
  }
  return walk;
}

std::vector<double> clock(double seconds, double first_hz, double second_hz) {
  std::vector<double> time_s{0};
  while (time_s.back() < seconds)
    time_s.push_back(time_s.back() +
                     1 / (static_cast<int>(time_s.back() + 1e-9) % 2 == 0 ? first_hz : second_hz));
  return time_s;
}

TEST(PedestrianMotion, FindsTheSameStepsAtAnyFrameRateAndWhereItChanges) {
  const std::vector<std::pair<double, double>> rates{{25, 25}, {12.5, 12.5}, {24, 24}, {30, 30}, {50, 50},
                                                     {60, 60}, {25, 12.5},   {60, 24}, {30, 10}};
  for (const auto& [first_hz, second_hz] : rates) {
    SCOPED_TRACE(testing::Message() << first_hz << ' ' << second_hz);
    const vo::Walk walk = bouncing_walk(clock(20, first_hz, second_hz));
    const vo::PedestrianMotion motion = vo::pedestrian_motion(walk);
    // Every half second, but for the one at the end.
    EXPECT_NEAR(static_cast<double>(motion.detection.steps.size()), 40, 1);
    for (const vo::Step& step : motion.detection.steps) {
      EXPECT_EQ(step.time_s, walk.time_s[step.frame]);
      // The change over three frames lags by half of them, and a step is found to a frame.
      const double off_s = std::remainder(step.time_s, 0.5);
      EXPECT_LE(std::abs(off_s - 1.5 / first_hz), 1.5 / std::min(first_hz, second_hz));
    }
    EXPECT_EQ(motion.activity[10].activity, vo::Activity::kWalking);
    EXPECT_NEAR(motion.activity[10].step_hz, 2, 0.1);
    EXPECT_NEAR(motion.signal.heading_rad.back(), 1, 0.02);  // 0.05 a second
  }
}

TEST(PedestrianMotion, WalksOnOverAShortJumpOfTheClock) {
  for (const double jump_s : {0.5, 1.0, 2.0, 2.9}) {
    std::vector<double> time_s = clock(30, 25, 25);
    for (std::size_t i = 375; i < time_s.size(); ++i) time_s[i] += jump_s;
    const vo::Walk walk = bouncing_walk(time_s);
    const vo::PedestrianMotion motion = vo::pedestrian_motion(walk);
    EXPECT_NEAR(static_cast<double>(motion.detection.steps.size()), 2 * (30 + jump_s), 1) << jump_s;
    for (const vo::Step& step : motion.detection.steps) {
      if (step.time_s <= time_s[374] || step.time_s >= time_s[375]) continue;
      EXPECT_EQ(step.frame, 375U);  // nobody saw them
      EXPECT_TRUE(step.bridged);
    }
    double walked_m = 0;
    for (const double moved_m : motion.displacement_m) walked_m += moved_m;
    EXPECT_NEAR(walked_m, 0.7 * 2 * (30 + jump_s), 0.7) << jump_s;
  }
}

TEST(PedestrianMotion, KnowsNothingOfALongJumpOfTheClock) {
  for (const double jump_s : {3.5, 10.0, 3600.0}) {
    std::vector<double> time_s = clock(30, 25, 25);
    for (std::size_t i = 375; i < time_s.size(); ++i) time_s[i] += jump_s;
    const vo::Walk walk = bouncing_walk(time_s);
    const vo::PedestrianMotion motion = vo::pedestrian_motion(walk);
    EXPECT_NEAR(static_cast<double>(motion.detection.steps.size()), 60, 1) << jump_s;
    for (const vo::Step& step : motion.detection.steps) EXPECT_EQ(step.time_s, walk.time_s[step.frame]);
    EXPECT_LE(motion.displacement_m[375], 0.7) << jump_s;  // of the step that ends after it
    EXPECT_EQ(motion.activity[static_cast<std::size_t>(15 + jump_s / 2)].activity, vo::Activity::kUnknown);
  }
}

TEST(PedestrianMotion, WithoutStepsStands) {
  const vo::PedestrianMotion motion =
      vo::without_steps(vo::pedestrian_motion(bouncing_walk(clock(20, 25, 25))));
  EXPECT_THAT(motion.detection.steps, IsEmpty());
  EXPECT_THAT(motion.displacement_m, Each(0));
  EXPECT_EQ(motion.trajectory.at_frame.back().pose.y_m, 0);
  EXPECT_EQ(motion.activity[10].activity, vo::Activity::kRiding);  // as the picture grows
}

TEST(PedestrianMotion, RefusesWalksItCannotReadStepsFrom) {
  vo::Walk untracked = tracked_walk(1, 1);
  untracked.tracked.clear();
  EXPECT_THROW(vo::pedestrian_motion(untracked), std::invalid_argument);
  EXPECT_THROW(vo::pedestrian_motion(tracked_walk(1, 1, 8)), vo::Error);  // 8 frames/s, filtered at 4 Hz
}

}  // namespace
