#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <simulate/failure.hpp>
#include <simulate/simulator.hpp>
#include <vo/base/error.hpp>

namespace {

using simulate::FailureKind;

TEST(SpreadFailures, AreEvenAndTakeTurns) {
  const auto failures = simulate::spread_failures(5, 2, 60);
  ASSERT_EQ(failures.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(failures[i].begin_s, 10.0 * static_cast<double>(i + 1) - 1);
    EXPECT_DOUBLE_EQ(failures[i].end_s, 10.0 * static_cast<double>(i + 1) + 1);
  }
  EXPECT_EQ(failures[0].kind, FailureKind::kBlackout);
  EXPECT_EQ(failures[3].kind, FailureKind::kBlankWall);
  EXPECT_EQ(failures[4].kind, FailureKind::kBlackout);
  EXPECT_TRUE(simulate::spread_failures(0, 2, 60).empty());
}

TEST(SpreadFailures, DoNotOverlap) {
  EXPECT_EQ(simulate::spread_failures(5, 10, 60).back().end_s, 55);
  EXPECT_THROW(simulate::spread_failures(5, 10.5, 60), vo::Error);
  EXPECT_TRUE(simulate::spread_failures(0, 90, 60).empty());
}

TEST(FailureAt, IsTheOneAtThatTime) {
  const auto failures = simulate::spread_failures(5, 2, 60);
  EXPECT_FALSE(simulate::failure_at(failures, 8.9));
  EXPECT_EQ(simulate::failure_at(failures, 9)->kind, FailureKind::kBlackout);
  EXPECT_EQ(simulate::failure_at(failures, 20)->kind, FailureKind::kBlur);
  EXPECT_FALSE(simulate::failure_at(failures, 11));
}

TEST(Pan, GoesOutAndComesBack) {
  const simulate::Failure pan{FailureKind::kPan, 10, 14};
  EXPECT_NEAR(simulate::pan_rad(pan, 10), 0, 1e-12);  // rounding
  EXPECT_NEAR(simulate::pan_rad(pan, 12), 2 * std::numbers::pi / 3, 1e-12);
  EXPECT_NEAR(simulate::pan_rad(pan, 14), 0, 1e-12);
  EXPECT_EQ(simulate::pan_rad({FailureKind::kBlur, 10, 14}, 12), 0);
}

TEST(Spoil, LeavesNothingToBeSeen) {
  cv::Mat checked(64, 64, CV_8UC3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x)
      checked.at<cv::Vec3b>(y, x) = cv::Vec3b::all((x / 2 + y / 2) % 2 == 0 ? 40 : 220);
  }
  for (const FailureKind kind :
       {FailureKind::kBlackout, FailureKind::kBlur, FailureKind::kBlankWall, FailureKind::kPan}) {
    cv::Mat image = checked.clone();
    simulate::spoil(image, kind);
    cv::Scalar mean, deviation;
    cv::meanStdDev(image, mean, deviation);
    if (kind == FailureKind::kPan) {
      EXPECT_EQ(deviation[0], 90);  // half 40, half 220: nothing taken
    } else {
      EXPECT_LT(deviation[0], 10) << static_cast<int>(kind);  // of 90
    }
  }
}

TEST(Simulator, FailsWhenAskedTo) {
  simulate::Options options;
  options.length_m = 12;
  options.size = {64, 36};
  options.failures = 1;
  options.failure_s = 1;
  const simulate::WalkSimulator walk(options);
  options.failures = 0;
  const simulate::WalkSimulator sound(options);
  ASSERT_EQ(walk.failures().size(), 1U);
  const auto black = static_cast<int>((walk.failures()[0].begin_s + 0.5) * options.frame_rate_hz);
  EXPECT_LT(cv::mean(walk.render(black))[0], 10);
  EXPECT_GT(cv::mean(sound.render(black))[0], 30);
  EXPECT_EQ(cv::norm(walk.render(5), sound.render(5)), 0);
}

}  // namespace
