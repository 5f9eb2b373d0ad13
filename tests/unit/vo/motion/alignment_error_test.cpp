#include "support/made_errors.hpp"
#include "support/random_images.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Errors that are given for each frame and do not depend on the span.
vo::AlignmentErrors errors_of(const std::vector<float>& per_frame, std::size_t spans) {
  return test_support::made_errors(per_frame.size(), 10, spans,
                                   [&](std::size_t i, std::size_t) { return per_frame[i]; });
}

std::vector<double> times(std::size_t frames, double rate_hz = 10) {
  std::vector<double> time_s(frames);
  for (std::size_t i = 0; i < frames; ++i) time_s[i] = static_cast<double>(i) / rate_hz;
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
  const vo::AlignmentErrors errors = vo::alignment_errors(images, times(kFrames, 25), {.spans = 3});
  ASSERT_EQ(errors.spans(), 3U);
  ASSERT_EQ(errors.frames(), kFrames);
  for (std::size_t s = 1; s <= 3; ++s) {
    for (std::size_t i = 0; i < kFrames; ++i) {
      const vo::Comparison& compared = errors.by_span[s - 1][i];
      ASSERT_EQ(compared.made(), i + s < kFrames);
      if (!compared.made()) continue;
      int sum = 0;
      for (std::size_t k = 0; k < 30; ++k) sum += std::abs(images[i][k] - images[i + s][k]);
      EXPECT_EQ(compared.frames, s);
      EXPECT_FLOAT_EQ(compared.seconds, static_cast<float>(s) / 25);
      EXPECT_FLOAT_EQ(compared.error, static_cast<float>(sum) / (16.0F * 30));
    }
  }
}

TEST(AlignmentErrors, TakeTheFrameNearestToEachSpan) {
  // By brute force, on a clock that stutters, drops frames, and jumps.
  vo::Rng rng(7);
  const auto images = random_images(3, 3, 400, 5);
  std::vector<double> time_s{0};
  while (time_s.size() < images.size())
    time_s.push_back(time_s.back() + (time_s.size() == 200 ? 7 : rng.uniform(0.005, 0.09)));
  const vo::AlignmentErrors errors = vo::alignment_errors(images, time_s);
  ASSERT_EQ(errors.spans(), 10U);
  for (std::size_t k = 0; k < errors.spans(); ++k) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      const double at_s = time_s[i] + 0.04 * static_cast<double>(k + 1);
      std::size_t nearest = i;
      for (std::size_t j = i + 1; j < images.size(); ++j)
        if (nearest == i || std::abs(time_s[j] - at_s) < std::abs(time_s[nearest] - at_s)) nearest = j;
      // Half a span, and 0.1 ms for rounded times.
      const bool near = nearest > i && std::abs(time_s[nearest] - at_s) <= 0.02 + 1e-4;
      EXPECT_EQ(errors.by_span[k][i].frames, near ? nearest - i : 0) << k << ' ' << i;
    }
  }
}

TEST(AlignmentErrors, AreThoseOfTheSameTimesAtAnyFrameRate) {
  // Of 50 frames/s every second frame, of 12.5 frames/s the even spans alone.
  const auto images = random_images(4, 4, 80, 6);
  const auto all = vo::alignment_errors(images, times(80, 50));
  std::vector<std::size_t> even, fourth;
  for (std::size_t i = 0; i < 80; i += 2) even.push_back(i);
  for (std::size_t i = 0; i < 80; i += 4) fourth.push_back(i);
  const auto at_25 = vo::alignment_errors(vo::select(images, even), times(40, 25));
  const auto at_12 = vo::alignment_errors(vo::select(images, fourth), times(20, 12.5));
  for (std::size_t k = 0; k < 10; ++k) {
    for (std::size_t i = 0; i + k + 1 < 40; ++i) {
      EXPECT_EQ(at_25.by_span[k][i].error, all.by_span[k][2 * i].error);
      EXPECT_EQ(at_25.by_span[k][i].frames * 2, all.by_span[k][2 * i].frames);
    }
    for (std::size_t i = 0; 2 * i + k + 1 < 40; ++i) {
      const vo::Comparison& compared = at_12.by_span[k][i];
      EXPECT_EQ(compared.made(), k % 2 == 1);
      EXPECT_EQ(compared.error, k % 2 == 1 ? all.by_span[k][4 * i].error : 0);
    }
  }
}

TEST(AlignmentErrors, OfSlowRecordingsReachFiveFrames) {
  for (const double rate_hz : {10.0, 1.0, 0.01}) {
    const auto errors = vo::alignment_errors(random_images(2, 2, 20, 8), times(20, rate_hz));
    for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(errors.by_span[k][0].frames, k % 2 == 1 ? (k + 1) / 2 : 0);
  }
}

TEST(AlignmentErrors, OfShortWalksEndWithTheWalk) {
  const vo::AlignmentErrors two = vo::alignment_errors(random_images(2, 2, 2, 3), times(2, 25), {.spans = 4});
  EXPECT_EQ(two.spans(), 4U);
  EXPECT_TRUE(two.by_span[0][0].made());
  EXPECT_FALSE(two.by_span[0][1].made());
  EXPECT_FALSE(two.by_span[1][0].made());
  EXPECT_EQ(vo::alignment_errors(random_images(2, 2, 1, 3), times(1)).frames(), 1U);
  EXPECT_EQ(vo::alignment_errors(random_images(2, 2, 0, 3), {}).frames(), 0U);
  EXPECT_THROW(vo::alignment_errors(random_images(2, 2, 2, 3), times(2), {.spans = 0}),
               std::invalid_argument);
  EXPECT_THROW(vo::alignment_errors(random_images(2, 2, 2, 3), times(3)), std::invalid_argument);
}

TEST(AlignmentErrors, AreTheSameForAnyThreadCount) {
  const auto images = random_images(8, 4, 60, 4);
  vo::set_thread_count(1);
  const auto one = vo::mean_errors(vo::alignment_errors(images, times(60, 25)));
  vo::set_thread_count(4);
  EXPECT_EQ(vo::mean_errors(vo::alignment_errors(images, times(60, 25))).error, one.error);
  vo::set_thread_count(0);
}

TEST(ErrorCourse, WorkedExample) {
  // Five frames 0.1 s apart, one span; the last has no successor and takes its neighbour's. The usual error
  // is (1 + 1 + 4 + 2) / 4 = 2. A window of 0.2 s holds a frame and its neighbours.
  const vo::ErrorCourse course = vo::error_course(errors_of({1, 1, 4, 2, 9}, 1), times(5), {},
                                                  {.spans = 1, .smoothing_s = 0.21, .high_error_mads = 2});
  EXPECT_THAT(course.relative, ElementsAre(0.5, 0.5, 2, 1, 1));
  ASSERT_EQ(course.smoothed.size(), 5U);
  const double expected[] = {0.5, 1, 3.5 / 3, 4.0 / 3, 1};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(course.smoothed[i], expected[i], 1e-12) << i;
  // Median 1; deviations 0.5, 0, 1/6, 1/3, 0, of median 1/6.
  EXPECT_NEAR(course.limit, 1 + 2.0 / 6, 1e-12);
}

TEST(ErrorCourse, HasNoLimitWithoutAFrameThatCounts) {
  const auto course = vo::error_course(errors_of({1, 2, 3}, 1), times(3), {true, true, true});
  EXPECT_EQ(course.limit, std::numeric_limits<double>::infinity());
  EXPECT_THAT(course.smoothed, Each(0.0));
  EXPECT_THAT(vo::error_course({}, {}).smoothed, IsEmpty());
  EXPECT_THROW(vo::error_course(errors_of({1, 1}, 1), times(3)), std::invalid_argument);
}

TEST(HighErrorWindows, AreThoseOfAPlantedTurn) {
  // Alternating 0.3 and 0.4, and 1.2 in frames 40..59. A window of 1 s holds 11 frames, so the turn lifts
  // the mean above the rest by at most 5 frames beyond its ends, and surely at its middle. The frame errors
  // of the last frames average fewer separations, all of the same value here.
  std::vector<float> per_frame(100);
  for (std::size_t i = 0; i < per_frame.size(); ++i) per_frame[i] = i % 2 == 0 ? 0.3F : 0.4F;
  std::fill(per_frame.begin() + 40, per_frame.begin() + 60, 1.2F);
  const auto high = vo::high_error_windows(errors_of(per_frame, 3), times(100), {}, {.smoothing_s = 1});
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
  const vo::AlignmentErrorOptions options{.spans = 1, .smoothing_s = 0.7, .high_error_mads = 1};

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

  const auto high = vo::high_error_windows(errors_of(per_frame, 1), time_s, {}, options);
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

TEST(HighErrorWindows, AreJudgedWithoutWhatIsLeftOut) {
  // Three quarters of the walk stand, at a tenth of the error: by all frames walking would be the exception.
  std::vector<float> per_frame(400, 0.03F);
  for (std::size_t i = 0; i < 100; ++i) per_frame[i] = i % 2 == 0 ? 0.3F : 0.4F;
  std::vector<bool> standing(400, true);
  std::fill(standing.begin(), standing.begin() + 100, false);
  const auto errors = errors_of(per_frame, 3);
  EXPECT_THAT(vo::high_error_windows(errors, times(400), standing, {.smoothing_s = 1}), Each(false));
  const auto by_all = vo::high_error_windows(errors, times(400), {}, {.smoothing_s = 1});
  EXPECT_TRUE(by_all[50]);
  EXPECT_THAT(vo::high_error_windows(errors, times(400), std::vector<bool>(400, true)), Each(false));
  EXPECT_THROW(vo::high_error_windows(errors, times(400), {true}), std::invalid_argument);
}

TEST(HighErrorWindows, DoNotMistakeALowFrameRateForMotion) {
  // Every other second at half the frame rate: only the longer spans, of larger error, are there.
  std::vector<double> time_s{0};
  while (time_s.back() < 60)
    time_s.push_back(time_s.back() + (static_cast<int>(time_s.back()) % 2 == 0 ? 0.04 : 0.08));
  vo::AlignmentErrors errors = vo::alignment_errors(random_images(2, 2, time_s.size(), 1), time_s);
  for (auto& comparisons : errors.by_span)
    for (vo::Comparison& compared : comparisons) compared.error = compared.seconds;
  EXPECT_THAT(vo::high_error_windows(errors, time_s, {}, {.smoothing_s = 0.5, .high_error_mads = 6}),
              Each(false));
}

TEST(HighErrorWindows, OfNoFrameOrOne) {
  EXPECT_THAT(vo::high_error_windows({}, {}), IsEmpty());
  EXPECT_THAT(vo::high_error_windows(vo::alignment_errors(random_images(2, 2, 1, 3), times(1)), times(1)),
              ElementsAre(false));
  EXPECT_THROW(vo::high_error_windows(errors_of({1, 1}, 1), times(3)), std::invalid_argument);
}

TEST(MeanErrors, WorkedExample) {
  vo::AlignmentErrors errors;
  errors.by_span = {
      {{1, 0.5F, 1}, {1, 0.5F, 2}, {1, 2.0F, 6}, {}}, {{}, {2, 1.5F, 5}, {}, {}}, {{}, {}, {}, {}}};
  const vo::MeanErrors means = vo::mean_errors(errors);
  EXPECT_THAT(means.seconds, ElementsAre(0, 1, 1.5));
  EXPECT_THAT(means.error, ElementsAre(0, 3, 5));
  const vo::MeanErrors some = vo::mean_errors(errors, {true, true, false, false});
  EXPECT_THAT(some.seconds, ElementsAre(0, 2));
  EXPECT_THAT(some.error, ElementsAre(0, 6));
  EXPECT_THAT(vo::mean_errors(errors, std::vector<bool>(4, true)).error, ElementsAre(0));
  EXPECT_THROW(vo::mean_errors(errors, {true}), std::invalid_argument);
  EXPECT_THAT(vo::mean_errors({}).error, ElementsAre(0));
}

TEST(MeanErrors, AreOfEachDistanceOnce) {
  std::vector<double> time_s;
  for (int i = 0; i < 80; ++i) time_s.push_back(i / 20.0);
  const auto means = vo::mean_errors(vo::alignment_errors(test_support::random_images(4, 4, 80, 6), time_s));
  EXPECT_GT(means.seconds.size(), 6U);
  for (std::size_t k = 1; k < means.seconds.size(); ++k)
    EXPECT_GT(means.seconds[k], means.seconds[k - 1] + 0.01) << k;
}

}  // namespace
