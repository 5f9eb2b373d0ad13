#include "support/random_images.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/motion/difference_pictures.hpp>

namespace {

using test_support::random_images;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::size_t kOne[] = {1};

std::vector<double> times_at_25_hz(std::size_t frames) {
  std::vector<double> time_s(frames);
  for (std::size_t i = 0; i < frames; ++i) time_s[i] = static_cast<double>(i) / 25;
  return time_s;
}

vo::ImageStack stack_of(int width, int height, const std::vector<std::uint8_t>& pixels) {
  vo::ImageStack stack = vo::make_image_stack(width, height, 0);
  stack.pixels.assign(pixels.begin(), pixels.end());
  return stack;
}

TEST(DifferencePictures, WorkedExample) {
  // Two pixels, three frames: the first pixel stays, the second goes 10, 40, 20.
  const vo::ImageStack images = stack_of(2, 1, {7, 10, 7, 40, 7, 20});
  const vo::AlignmentErrors errors = vo::alignment_errors(images, times_at_25_hz(3), {.spans = 2});
  constexpr std::size_t kSpans[] = {1, 2};
  const auto pictures = vo::difference_pictures(images, errors, kSpans);
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_THAT(pictures[0].mean, ElementsAre(0, 25));  // (30 + 20) / 2
  EXPECT_EQ(pictures[0].pairs, 2U);
  EXPECT_FLOAT_EQ(static_cast<float>(pictures[0].seconds), 0.04F);
  EXPECT_THAT(pictures[1].mean, ElementsAre(0, 10));  // |20 - 10|
  EXPECT_EQ(pictures[1].pairs, 1U);
  EXPECT_FLOAT_EQ(static_cast<float>(pictures[1].seconds), 0.08F);
}

TEST(DifferencePictures, EqualTheDefinitionWithoutFramesLeftOut) {
  constexpr std::size_t kFrames = 40, kSpan = 3;
  const vo::ImageStack images = random_images(5, 4, kFrames, 3);
  const vo::AlignmentErrors errors = vo::alignment_errors(images, times_at_25_hz(kFrames), {.spans = 5});
  std::vector<bool> excluded(kFrames, false);
  for (std::size_t i = 10; i < 20; ++i) excluded[i] = true;
  constexpr std::size_t kSpans[] = {kSpan};
  const auto pictures = vo::difference_pictures(images, errors, kSpans, excluded);
  for (std::size_t k = 0; k < images.image_size(); ++k) {
    int sum = 0, count = 0;
    for (std::size_t i = 0; i + kSpan < kFrames; ++i) {
      if (excluded[i]) continue;
      sum += std::abs(images[i][k] - images[i + kSpan][k]);
      ++count;
    }
    EXPECT_DOUBLE_EQ(pictures[0].mean[k], static_cast<double>(sum) / count);
  }
}

TEST(DifferencePictures, OfAConstantWalkAreDark) {
  const vo::ImageStack images = stack_of(2, 2, std::vector<std::uint8_t>(4 * 12, 99));
  const vo::AlignmentErrors errors = vo::alignment_errors(images, times_at_25_hz(12));
  for (const vo::DifferencePicture& picture : vo::difference_pictures(images, errors)) {
    EXPECT_THAT(picture.mean, Each(0.0));
    EXPECT_GT(picture.pairs, 0U);
  }
}

TEST(DifferencePictures, OfOneFrameHaveNoPairs) {
  const vo::ImageStack images = random_images(3, 2, 1, 4);
  const vo::AlignmentErrors errors = vo::alignment_errors(images, times_at_25_hz(1));
  const auto pictures = vo::difference_pictures(images, errors, kOne);
  EXPECT_EQ(pictures[0].pairs, 0U);
  EXPECT_EQ(pictures[0].seconds, 0);
  EXPECT_THAT(pictures[0].mean, Each(0.0));
  EXPECT_THAT(vo::difference_pictures(images, errors, {}), IsEmpty());
}

TEST(DifferencePictures, RefuseWhatDoesNotFit) {
  const vo::ImageStack images = random_images(3, 2, 5, 4);
  const vo::AlignmentErrors errors = vo::alignment_errors(images, times_at_25_hz(5), {.spans = 2});
  constexpr std::size_t kNone[] = {0}, kTooLong[] = {3};
  EXPECT_THROW(vo::difference_pictures(random_images(3, 2, 4, 4), errors, kOne), std::invalid_argument);
  EXPECT_THROW(vo::difference_pictures(images, errors, kNone), std::invalid_argument);
  EXPECT_THROW(vo::difference_pictures(images, errors, kTooLong), std::invalid_argument);
  EXPECT_THROW(vo::difference_pictures(images, errors, kOne, {true}), std::invalid_argument);
}

}  // namespace
