#include "place/describe/hog.hpp"

#include "support/described_views.hpp"

#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using place::ColumnStack;
using test_support::keyframes_of;

TEST(Hog, OfOneCellWithAnEdge) {
  // All of the gradient in one cell and direction: the block it is the upper left cell of is 1 there, after
  // the clip at 0.2 and the second division.
  std::vector<float> cells(8 * 16 * 12);
  cells[(3 * 16 + 5) * 12 + 7] = 1000;
  const std::vector<float> blocks = place::hog_of(cells);
  ASSERT_EQ(blocks.size(), 15U * 7U * 48U);
  EXPECT_NEAR(blocks[(5 * 7 + 3) * 48 + 7], 1, 1e-4);       // floors of 100 and 1e-6 under the lengths
  EXPECT_NEAR(blocks[(4 * 7 + 3) * 48 + 12 + 7], 1, 1e-4);  // a block further left: its right cell
  EXPECT_NEAR(std::accumulate(blocks.begin(), blocks.end(), 0.0), 4, 1e-3);
}

TEST(Hog, KnowsEachPlaceAgainInOtherLight) {
  const auto descriptor = place::make_hog({});
  const place::KeyframeRecords reference = keyframes_of(*descriptor, 20, {}),
                               query = keyframes_of(*descriptor, 20, {.gain = 0.5, .noise = 3});
  const place::Bytes learned = descriptor->learn(reference);
  const auto r = std::get<ColumnStack>(descriptor->describe(reference, learned)),
             q = std::get<ColumnStack>(descriptor->describe(query, learned));
  ASSERT_EQ(r.size(), 20U);
  EXPECT_EQ(r.columns, 15);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const auto product = [&](std::size_t j) {
      return std::inner_product(q[i].begin(), q[i].end(), r[j].begin(), 0.0);
    };
    for (std::size_t j = 0; j < r.size(); ++j)
      if (j != i) {
        EXPECT_GT(product(i), product(j));
      }
  }
}

TEST(Hog, OfOneGreyAndOfNothingAreNothing) {
  EXPECT_THAT(place::hog_of(std::vector<float>(8 * 16 * 12)), testing::Each(0.0F));
  const auto descriptor = place::make_hog({});
  const place::Bytes learned = descriptor->learn(keyframes_of(*descriptor, 2, {}));
  EXPECT_EQ(count_of(descriptor->describe({}, learned)), 0U);
}

TEST(Hog, RefusesWhatIsNotItsOwn) {
  EXPECT_THROW(place::hog_of(std::vector<float>(9)), std::invalid_argument);
  const auto descriptor = place::make_hog({});
  place::KeyframeRecords keyframes = keyframes_of(*descriptor, 2, {});
  EXPECT_THROW(static_cast<void>(descriptor->describe(keyframes, place::Bytes(3))), vo::Error);
  keyframes.records[1].pop_back();
  EXPECT_THROW(static_cast<void>(descriptor->learn(keyframes)), vo::Error);
}

}  // namespace
