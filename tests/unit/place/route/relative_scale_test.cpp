#include "support/random_images.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <place/match/cost_matrix.hpp>
#include <place/route/relative_scale.hpp>
#include <vo/base/parallel.hpp>

namespace {

using test_support::random_images;

/// What is seen at a place along a route, in keyframes of the reference: random pictures at whole places,
/// blended between them.
std::vector<std::uint8_t> view(const vo::ImageStack& landmarks, double place) {
  const auto before = static_cast<std::size_t>(place);
  const double share = place - static_cast<double>(before);
  std::vector<std::uint8_t> picture;
  for (std::size_t k = 0; k < landmarks.image_size(); ++k) {
    picture.push_back(static_cast<std::uint8_t>(
        std::lround(std::lerp(landmarks[before][k], landmarks[before + 1][k], share))));
  }
  return picture;
}

/// A walk that takes `count` pictures, `step` apart, from `start`.
vo::ImageStack walk(double start, double step, std::size_t count) {
  const vo::ImageStack landmarks = random_images(8, 8, 250, 1);
  vo::ImageStack pictures = vo::make_image_stack(8, 8, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto picture = view(landmarks, start + step * static_cast<double>(i));
    pictures.pixels.insert(pictures.pixels.end(), picture.begin(), picture.end());
  }
  return pictures;
}

double relative_scale(const vo::ImageStack& query, const vo::ImageStack& reference,
                      const place::RelativeScaleOptions& options = {}) {
  return place::relative_scale(place::cost_matrix(query, reference), options).scale;
}

/// Lines of 10 terms reach 5 keyframes from their pair. Slopes whose ends differ by less than half a
/// reference keyframe round to the same or equally good lines, and the default steps are 3 percent apart.
constexpr double kAccuracy = 0.5 / 5;

TEST(RelativeScale, FindsAPlantedScale) {
  for (const double scale : {0.5, 1.3, 3.0}) {
    const double found = relative_scale(walk(10, scale, 60), walk(0, 1, 200));
    EXPECT_NEAR(found, scale, kAccuracy * std::max(1.0, scale)) << scale;
  }
}

TEST(RelativeScale, StaysNearOneByAStrongPrior) {
  const auto query = walk(10, 1.5, 60), reference = walk(0, 1, 120);
  EXPECT_NEAR(relative_scale(query, reference, {.prior_weight = 1}), 1.5, 1.5 * kAccuracy);
  EXPECT_NEAR(relative_scale(query, reference, {.prior_weight = 1e6}), 1, kAccuracy);
}

TEST(RelativeScale, OfTheOtherDirectionIsTheInverse) {
  for (const double scale : {0.6, 1.5}) {
    const auto query = walk(20, scale, 80), reference = walk(0, 1, 150);
    const double there = relative_scale(query, reference);
    const double back = relative_scale(reference, query);
    // Each is right to kAccuracy, relative to the larger of the scale and 1.
    EXPECT_NEAR(there * back, 1, 2 * kAccuracy / std::min(scale, 1 / scale)) << scale;
  }
}

TEST(RelativeScale, StaysWithinTheLargest) {
  const double found = relative_scale(walk(10, 3, 60), walk(0, 1, 200), {.largest = 1.5});
  EXPECT_LE(found, 1.5 + 1e-12);
  EXPECT_GE(found, 1 / 1.5 - 1e-12);
}

TEST(RelativeScale, OfAWalkWithItselfIsOne) {
  const auto reference = walk(0, 1, 100);
  EXPECT_NEAR(relative_scale(reference, reference), 1, kAccuracy);
}

TEST(RelativeScale, OfPicturesAllAlikeIsOne) {
  // Every slope costs the same: the middle of them all.
  vo::ImageStack grey = vo::make_image_stack(8, 8, 30);
  EXPECT_NEAR(relative_scale(grey, grey), 1, 1e-12);
}

TEST(RelativeScale, IsUsedOnlyWhereItIsSure) {
  // A walk at twice the spacing, of which the pictures show more and more of something else.
  const auto reference = walk(0, 1, 200);
  const vo::ImageStack others = random_images(8, 8, 60, 7);
  double last_gain = 1e9;
  for (const double noise : {0.0, 0.5, 1.0}) {
    vo::ImageStack query = walk(10, 2, 60);
    for (std::size_t k = 0; k < query.pixels.size(); ++k)
      query.pixels[k] =
          static_cast<std::uint8_t>(std::lround(std::lerp(query.pixels[k], others.pixels[k], noise)));
    const auto found = place::relative_scale(place::cost_matrix(query, reference));
    EXPECT_LE(found.gain, last_gain) << noise;
    last_gain = found.gain;
    EXPECT_EQ(found.scale, noise < 1 ? found.best : 1) << noise;
    if (noise < 1) {
      EXPECT_NEAR(found.best, 2, 2 * kAccuracy) << noise;
    }
    // What is asked for beyond what it gains is not there.
    EXPECT_EQ(place::relative_scale(place::cost_matrix(query, reference), {.min_gain = found.gain + 1}).scale,
              1);
  }
}

TEST(RelativeScale, OfAlmostNothingIsOne) {
  const auto reference = walk(0, 1, 20);
  EXPECT_EQ(relative_scale(walk(0, 1, 1), reference), 1);
  EXPECT_EQ(relative_scale(reference, walk(0, 1, 1)), 1);
  EXPECT_EQ(relative_scale(walk(0, 1, 0), reference), 1);
  const auto sixteen = walk(10, 1.5, 16), fourteen = walk(10, 1.5, 14);
  EXPECT_NEAR(relative_scale(sixteen, walk(0, 1, 60)), 1.5, 1.5 * kAccuracy);
  EXPECT_EQ(relative_scale(fourteen, walk(0, 1, 60)), 1);
  EXPECT_TRUE(std::isfinite(relative_scale(walk(0, 1, 2), walk(0, 1, 2))));
}

TEST(RelativeScale, RefusesOptionsOutOfRange) {
  const auto reference = walk(0, 1, 5);
  EXPECT_THROW(relative_scale(reference, reference, {.largest = 1}), std::invalid_argument);
  EXPECT_THROW(relative_scale(reference, reference, {.steps = 2}), std::invalid_argument);
  EXPECT_THROW(relative_scale(reference, reference, {.length = 1}), std::invalid_argument);
  EXPECT_THROW(relative_scale(reference, reference, {.min_gain = -1}), std::invalid_argument);
}

TEST(RelativeScale, IsTheSameForAnyThreadCount) {
  const auto query = walk(10, 1.4, 60), reference = walk(0, 1, 120);
  vo::set_thread_count(1);
  const double one = relative_scale(query, reference);
  vo::set_thread_count(4);
  EXPECT_EQ(relative_scale(query, reference), one);
  vo::set_thread_count(0);
}

}  // namespace
