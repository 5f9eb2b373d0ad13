#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/base/large_memory.hpp>
#include <vo/base/rng.hpp>
#include <vo/base/trajectory.hpp>

namespace {

using testing::StrEq;

TEST(Error, ComposesOneLine) {
  EXPECT_THAT(vo::Error("walk.mp4", "is empty").what(), StrEq("walk.mp4: is empty"));
  EXPECT_THAT(vo::Error("a.csv: row 3", "frame 'x'\nis no number", "an integer").what(),
              StrEq("a.csv: row 3: frame 'x' is no number; expected an integer"));
}

TEST(ResizePopulated, KeepsWhatThereIsAndAddsZeros) {
  constexpr std::size_t kLarge = 10'000'001;  // bytes, of no whole page
  std::vector<std::uint8_t> bytes(kLarge, 7);
  vo::resize_populated(bytes, 2 * kLarge);
  ASSERT_EQ(bytes.size(), 2 * kLarge);
  EXPECT_EQ(std::ranges::count(bytes, 7), kLarge);
  EXPECT_EQ(bytes[kLarge - 1], 7);
  EXPECT_EQ(std::ranges::count(bytes, 0), kLarge);
  vo::resize_populated(bytes, 3);
  EXPECT_THAT(bytes, testing::ElementsAre(7, 7, 7));
  vo::resize_populated(bytes, 0);
  EXPECT_THAT(bytes, testing::IsEmpty());
}

TEST(LargeArray, BeginsAtALargePageAndHoldsWhatIsWritten) {
  for (const std::size_t size : {0, 1, 3'000'001}) {
    const auto values = vo::make_large_array<std::uint16_t>(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.get()) % (2 << 20), 0U);
    std::fill_n(values.get(), size, std::uint16_t{40'000});
    EXPECT_EQ(std::count(values.get(), values.get() + size, 40'000), static_cast<std::ptrdiff_t>(size));
  }
}

TEST(Rng, MatchesThePublishedSequence) {
  // First outputs of the reference SplitMix64 for seed 1234567.
  vo::Rng rng(1234567);
  EXPECT_EQ(rng.bits(), 6457827717110365317U);
  EXPECT_EQ(rng.bits(), 3203168211198807973U);
  EXPECT_EQ(rng.bits(), 9817491932198370423U);
}

TEST(Rng, HasTheMomentsOfItsDistributions) {
  vo::Rng rng(7);
  constexpr int kCount = 100000;
  double sum = 0, square = 0, uniform = 0;
  std::vector<int> histogram(5, 0);
  for (int i = 0; i < kCount; ++i) {
    const double x = rng.normal();
    sum += x;
    square += x * x;
    uniform += rng.uniform(2, 4);
    ++histogram[rng.index(5)];
  }
  // Five standard errors of each estimate.
  EXPECT_NEAR(sum / kCount, 0.0, 5 / std::sqrt(kCount));
  EXPECT_NEAR(square / kCount, 1.0, 5 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(uniform / kCount, 3.0, 5 * std::sqrt(4.0 / 12 / kCount));
  for (const int n : histogram) EXPECT_NEAR(n, kCount / 5, 5 * std::sqrt(kCount * 0.2 * 0.8));
  EXPECT_THROW(rng.index(0), std::invalid_argument);
  EXPECT_THROW(rng.uniform(1, 0), std::invalid_argument);
}

TEST(Trajectory, HeadsAlongItsPath) {
  // Ten metres east, ten north, a pose every half metre.
  vo::Trajectory walk;
  for (int i = 0; i <= 40; ++i)
    walk.push_back({1.0 * i, {std::min(0.5 * i, 10.0), std::max(0.0, 0.5 * i - 10), 0}});
  vo::head_along_path(walk, 3);
  constexpr double kEast = std::numbers::pi / 2;
  for (int i = 0; i <= 40; ++i) {
    const double heading = walk[static_cast<std::size_t>(i)].pose.heading_rad;
    // Away from the corner by twice the reach's half on either side: the heading is exactly that of the leg.
    if (i <= 14) {
      EXPECT_DOUBLE_EQ(heading, kEast) << i;
    }
    if (i >= 26) {
      EXPECT_DOUBLE_EQ(heading, 0) << i;
    }
    EXPECT_GE(heading, 0) << i;
    EXPECT_LE(heading, kEast) << i;
  }
  EXPECT_NEAR(walk[20].pose.heading_rad, kEast / 2,
              0.35);  // at the corner, by marks within 1.5 m on either side
}

TEST(Trajectory, HeadsNowhereWhereItDoesNotMove) {
  vo::Trajectory none;
  vo::head_along_path(none, 3);
  vo::Trajectory still{{0, {1, 1, 5}}, {1, {1, 1, 5}}};
  vo::head_along_path(still, 3);
  EXPECT_EQ(still[1].pose.heading_rad, 0);
  vo::Trajectory one{{0, {1, 1, 5}}};
  vo::head_along_path(one, 3);
  EXPECT_EQ(one[0].pose.heading_rad, 0);
  // Shorter than the reach: the heading between the ends.
  vo::Trajectory brief{{0, {0, 0, 0}}, {1, {0.1, 0, 0}}, {2, {0.2, 0.2, 0}}};
  vo::head_along_path(brief, 3);
  for (const auto& pose : brief) EXPECT_DOUBLE_EQ(pose.pose.heading_rad, std::numbers::pi / 4);
}

TEST(Trajectory, InterpolatesAlongTheShorterArc) {
  const double degree = std::numbers::pi / 180;
  const vo::Trajectory walk{{0, {0, 0, 170 * degree}}, {2, {4, 2, -170 * degree}}};
  const auto middle = vo::pose_at(walk, 1, 0);
  ASSERT_TRUE(middle);
  EXPECT_DOUBLE_EQ(middle->x_m, 2);
  EXPECT_DOUBLE_EQ(middle->y_m, 1);
  EXPECT_NEAR(std::abs(middle->heading_rad), std::numbers::pi, 1e-12);
  EXPECT_FALSE(vo::pose_at(walk, 2.2, 0.1));
  EXPECT_DOUBLE_EQ(vo::pose_at(walk, 2.05, 0.1)->x_m, 4);
  EXPECT_DOUBLE_EQ(vo::pose_at(walk, -0.05, 0.1)->x_m, 0);
  EXPECT_FALSE(vo::pose_at({}, 0, 1));
}

}  // namespace
