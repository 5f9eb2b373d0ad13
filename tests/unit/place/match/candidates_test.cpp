#include "support/random_images.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/candidates.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

using test_support::random_images;

/// Views that follow each other along a made-up wall, so that neighbours look alike: 16x8 windows of a
/// strip, two columns further on each.
vo::ImageStack wall_views(std::size_t count, std::uint64_t seed) {
  const int width = static_cast<int>(2 * count) + 16;
  const auto strip = random_images(width, 8, 1, seed);
  vo::ImageStack views = vo::make_image_stack(16, 8, count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t y = 0; y < 8; ++y) {
      for (std::size_t x = 0; x < 16; ++x)
        views[i][y * 16 + x] = strip.pixels[y * static_cast<std::size_t>(width) + 2 * i + x];
    }
  }
  return views;
}

/// The references from `first` on, each pixel blended with noise.
vo::ImageStack noisy(const vo::ImageStack& references, std::size_t first, std::size_t count) {
  auto views = random_images(references.width, references.height, count, 99);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < views.image_size(); ++k)
      views[i][k] = static_cast<std::uint8_t>((views[i][k] + 2 * references[first + i][k]) / 3);
  }
  return views;
}

TEST(Candidates, HoldThePlacesOfTheWalkWithTheirNeighbourhood) {
  const auto references = wall_views(8000, 1);
  const place::CandidateOptions options{.sample = 200, .run = 16, .stretches = 3, .margin = 20};
  for (const std::size_t first : {0, 3000, 7900}) {
    SCOPED_TRACE(first);
    const auto found = place::candidates(noisy(references, first, 100), references, options);
    EXPECT_TRUE(std::ranges::is_sorted(found));
    EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
    const std::size_t begin = first > 20 ? first - 20 : 0, end = std::min<std::size_t>(8000, first + 120);
    for (std::size_t r = begin; r < end; ++r) EXPECT_TRUE(std::ranges::binary_search(found, r)) << r;
    // The sample, and for each of the 7 runs at most 3 stretches of 3 runs and two margins.
    EXPECT_LE(found.size(), 200 + 7 * 3 * (3 * 16 + 2 * 20));
  }
}

TEST(Candidates, SeeTheBorderOfImagesThatNoSquaresFit) {
  // 17 x 9 pixels in squares of 4: the last column and row have narrow ones of their own, and all that
  // differs.
  vo::ImageStack references = random_images(17, 9, 3000, 5);
  for (std::size_t i = 0; i < references.size(); ++i)
    for (std::size_t y = 0; y < 8; ++y) std::ranges::fill(references[i].subspan(17 * y, 16), 128);
  const auto found =
      place::candidates(noisy(references, 1000, 64), references, {.sample = 200, .run = 16, .stretches = 3});
  for (std::size_t r = 1000; r < 1064; ++r) EXPECT_TRUE(std::ranges::binary_search(found, r)) << r;
  EXPECT_LT(found.size(), 2000U);
}

TEST(Candidates, OfASmallReferenceAreAllOfIt) {
  const auto references = random_images(8, 4, 50, 1);
  const auto found = place::candidates(random_images(8, 4, 5, 2), references, {.sample = 50});
  ASSERT_EQ(found.size(), 50U);
  for (std::size_t r = 0; r < 50; ++r) EXPECT_EQ(found[r], r);
  EXPECT_TRUE(place::candidates(references, random_images(8, 4, 0, 1)).empty());
}

TEST(Candidates, OfConstantReferencesAreNoTrouble) {
  vo::ImageStack references = vo::make_image_stack(8, 4, 60);
  const auto found = place::candidates(random_images(8, 4, 5, 2), references, {.sample = 10});
  EXPECT_GE(found.size(), 10U);
  EXPECT_LT(found.back(), 60U);
}

TEST(Candidates, AreTheSameForAnyThreadCount) {
  const auto references = wall_views(3000, 3);
  const auto queries = noisy(references, 500, 60);
  vo::set_thread_count(1);
  const auto one = place::candidates(queries, references);
  vo::set_thread_count(4);
  EXPECT_EQ(place::candidates(queries, references), one);
  vo::set_thread_count(0);
}

TEST(Candidates, RefuseWhatDoesNotFit) {
  const auto images = random_images(8, 4, 5, 1);
  EXPECT_THROW(place::candidates(images, random_images(4, 8, 5, 1)), std::invalid_argument);
  EXPECT_THROW(place::candidates(images, images, {.dimensions = 0}), std::invalid_argument);
  EXPECT_THROW(place::candidates(images, images, {.pool_px = 0}), std::invalid_argument);
}

}  // namespace
