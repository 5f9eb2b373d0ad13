#include "support/random_images.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>
#include <vo/motion/alignment_error.hpp>

namespace {

using test_support::random_images;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

/// Errors that are given for each frame and do not depend on the separation.
vo::AlignmentErrors errors_of(const std::vector<float>& per_frame, std::size_t max_separation) {
  vo::AlignmentErrors errors;
  errors.by_separation.assign(max_separation + 1, {});
  errors.by_separation[0].assign(per_frame.size(), 0.0F);
  for (std::size_t s = 1; s <= max_separation; ++s) {
    errors.by_separation[s].assign(per_frame.begin(), per_frame.end() - static_cast<std::ptrdiff_t>(s));
  }
  return errors;
}

/// Frames at 10 Hz.
std::vector<double> times(std::size_t frames) {
  std::vector<double> time_s(frames);
  for (std::size_t i = 0; i < frames; ++i) time_s[i] = 0.1 * static_cast<double>(i);
  return time_s;
}

TEST(AlignmentError, WorkedExample) {
  // |0| + |16| + |16| + |0| steps over 4 pixels, 16 steps to a deviation: half a deviation.
  const std::vector<std::uint8_t> a{128, 128, 144, 112}, b{128, 144, 128, 112};
  EXPECT_EQ(vo::alignment_error(a, b), 0.5);
}

TEST(AlignmentError, IsAMetric) {
  const auto images = random_images(5, 3, 3, 1);
  EXPECT_EQ(vo::alignment_error(images[0], images[0]), 0);
  EXPECT_GT(vo::alignment_error(images[0], images[1]), 0);
  EXPECT_EQ(vo::alignment_error(images[0], images[1]), vo::alignment_error(images[1], images[0]));
  // Integer sums over one constant; the slack is for the rounding of one division each.
  EXPECT_LE(vo::alignment_error(images[0], images[2]),
            vo::alignment_error(images[0], images[1]) + vo::alignment_error(images[1], images[2]) + 1e-12);
}

TEST(AlignmentError, RefusesImagesOfTwoSizesOrNone) {
  const std::vector<std::uint8_t> three(3), four(4);
  EXPECT_THROW(vo::alignment_error(three, four), std::invalid_argument);
  EXPECT_THROW(vo::alignment_error({}, {}), std::invalid_argument);
}

TEST(AlignmentErrors, EqualTheDefinition) {
  constexpr std::size_t kFrames = 7;
  const auto images = random_images(6, 5, kFrames, 2);
  const vo::AlignmentErrors errors = vo::alignment_errors(images, {.max_separation = 3});
  ASSERT_EQ(errors.max_separation(), 3);
  ASSERT_EQ(errors.frames(), kFrames);
  EXPECT_THAT(errors.by_separation[0], Each(0.0F));
  for (std::size_t s = 1; s <= 3; ++s) {
    ASSERT_EQ(errors.by_separation[s].size(), kFrames - s);
    for (std::size_t i = 0; i + s < kFrames; ++i) {
      int sum = 0;
      for (std::size_t k = 0; k < 30; ++k) sum += std::abs(images[i][k] - images[i + s][k]);
      EXPECT_FLOAT_EQ(errors.by_separation[s][i], static_cast<float>(sum) / (16.0F * 30));
    }
  }
}

TEST(AlignmentErrors, OfShortWalksEndWithTheWalk) {
  const vo::AlignmentErrors two = vo::alignment_errors(random_images(2, 2, 2, 3), {.max_separation = 4});
  EXPECT_EQ(two.max_separation(), 4);
  EXPECT_EQ(two.by_separation[1].size(), 1U);
  EXPECT_THAT(two.by_separation[2], IsEmpty());
  EXPECT_THAT(two.by_separation[4], IsEmpty());
  EXPECT_EQ(vo::alignment_errors(random_images(2, 2, 1, 3)).frames(), 1U);
  EXPECT_EQ(vo::alignment_errors(random_images(2, 2, 0, 3)).frames(), 0U);
  EXPECT_THROW(vo::alignment_errors(random_images(2, 2, 2, 3), {.max_separation = 0}), std::invalid_argument);
}

TEST(AlignmentErrors, AreTheSameForAnyThreadCount) {
  const auto images = random_images(8, 4, 60, 4);
  vo::set_thread_count(1);
  const auto one = vo::alignment_errors(images);
  vo::set_thread_count(4);
  EXPECT_EQ(vo::alignment_errors(images).by_separation, one.by_separation);
  vo::set_thread_count(0);
}

TEST(HighErrorWindows, AreThoseOfAPlantedTurn) {
  // Alternating 0.3 and 0.4, and 1.2 in frames 40..59. A window of 1 s holds 11 frames, so the turn lifts
  // the mean above the rest by at most 5 frames beyond its ends, and surely at its middle. The frame errors
  // of the last frames average fewer separations, all of the same value here.
  std::vector<float> per_frame(100);
  for (std::size_t i = 0; i < per_frame.size(); ++i) per_frame[i] = i % 2 == 0 ? 0.3F : 0.4F;
  std::fill(per_frame.begin() + 40, per_frame.begin() + 60, 1.2F);
  const auto high = vo::high_error_windows(errors_of(per_frame, 3), times(100), {.smoothing_s = 1});
  ASSERT_EQ(high.size(), 100U);
  for (std::size_t i = 0; i < 35; ++i) EXPECT_FALSE(high[i]) << i;
  for (std::size_t i = 40; i < 60; ++i) EXPECT_TRUE(high[i]) << i;
  for (std::size_t i = 65; i < 100; ++i) EXPECT_FALSE(high[i]) << i;
}

TEST(HighErrorWindows, EqualTheDefinition) {
  vo::Rng rng(5);
  std::vector<float> per_frame(81);  // odd, so the median is one of the values
  for (auto& error : per_frame) error = static_cast<float>(rng.uniform(0.2, 0.6));
  std::vector<double> time_s;  // uneven
  for (double t = 0; time_s.size() < per_frame.size(); t += rng.uniform(0.02, 0.2)) time_s.push_back(t);
  const vo::AlignmentErrorOptions options{.max_separation = 1, .smoothing_s = 0.7, .high_error_mads = 1};

  std::vector<double> smoothed;
  per_frame[80] = per_frame[79];  // the last frame has no successor and is as its neighbour
  for (const double centre : time_s) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      if (std::abs(time_s[i] - centre) > 0.35) continue;
      sum += per_frame[i];
      ++count;
    }
    smoothed.push_back(sum / count);
  }
  const auto median = [](std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  };
  const double centre = median(smoothed);
  std::vector<double> deviations;
  for (const double value : smoothed) deviations.push_back(std::abs(value - centre));
  const double limit = centre + median(deviations);

  const auto high = vo::high_error_windows(errors_of(per_frame, 1), time_s, options);
  std::size_t count = 0;
  for (std::size_t i = 0; i < high.size(); ++i) {
    EXPECT_EQ(high[i], smoothed[i] > limit) << i;
    count += high[i] ? 1 : 0;
  }
  EXPECT_GT(count, 0U);
  EXPECT_LT(count, 41U);  // what lies above the median is less than half
}

TEST(HighErrorWindows, AreNoneWhereTheErrorIsConstant) {
  for (const float error : {0.0F, 0.1F, 0.3F, 0.7F}) {
    EXPECT_THAT(vo::high_error_windows(errors_of(std::vector<float>(300, error), 3), times(300)), Each(false))
        << error;
  }
}

TEST(HighErrorWindows, OfNoFrameOrOne) {
  EXPECT_THAT(vo::high_error_windows({}, {}), IsEmpty());
  EXPECT_THAT(vo::high_error_windows(vo::alignment_errors(random_images(2, 2, 1, 3)), times(1)),
              ElementsAre(false));
  EXPECT_THROW(vo::high_error_windows(errors_of({1, 1}, 1), times(3)), std::invalid_argument);
}

TEST(MeanErrorBySeparation, WorkedExample) {
  vo::AlignmentErrors errors;
  errors.by_separation = {{0, 0, 0, 0}, {1, 2, 6}, {3, 5}, {7}};
  EXPECT_THAT(vo::mean_error_by_separation(errors), ElementsAre(0, 3, 4, 7));
  // Without frames 0 and 2: 2; 5; and at separation 3 nothing is left, so 5 again.
  EXPECT_THAT(vo::mean_error_by_separation(errors, {true, false, true, false}), ElementsAre(0, 2, 5, 5));
  EXPECT_THAT(vo::mean_error_by_separation(errors, std::vector<bool>(4, true)), Each(0));
  EXPECT_THROW(vo::mean_error_by_separation(errors, {true}), std::invalid_argument);
  EXPECT_THAT(vo::mean_error_by_separation({}), IsEmpty());
}

}  // namespace
