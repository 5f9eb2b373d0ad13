#include "place/describe/blocks.hpp"

#include "support/described_views.hpp"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::BlocksModel;
using place::Bytes;
using place::ColumnStack;
using test_support::records_of;
using test_support::view_of;

/// The cosine of two descriptors whose columns lie `shift` apart, over the columns that both have.
double cosine(const ColumnStack& a, std::size_t i, const ColumnStack& b, std::size_t j, int shift = 0) {
  double dot = 0, aa = 0, bb = 0;
  for (int c = std::max(0, -shift); c < std::min(a.columns, a.columns - shift); ++c) {
    for (int k = 0; k < a.channels; ++k) {
      const double x = a[i][static_cast<std::size_t>((c + shift) * a.channels + k)],
                   y = b[j][static_cast<std::size_t>(c * b.channels + k)];
      dot += x * y;
      aa += x * x;
      bb += y * y;
    }
  }
  return dot / std::sqrt(aa * bb);
}

class BlocksOfAStreet : public testing::Test {
 protected:
  static constexpr std::size_t kPlaces = 10;
  const std::unique_ptr<place::Descriptor> descriptor_ = place::make_blocks({});
  const std::vector<Bytes> reference_ = records_of(*descriptor_, kPlaces, {});
};

TEST_F(BlocksOfAStreet, KnowEachPlaceAgainInOtherLight) {
  const BlocksModel model = place::learn_blocks(reference_);
  const ColumnStack reference = place::describe_blocks(reference_, model),
                    query = place::describe_blocks(
                        records_of(*descriptor_, kPlaces, {.gain = 0.5, .noise = 3}), model);
  ASSERT_EQ(reference.size(), kPlaces);
  EXPECT_EQ(reference.descriptor_size(), 1024U);
  for (std::size_t q = 0; q < kPlaces; ++q)
    for (std::size_t r = 0; r < kPlaces; ++r)
      if (r != q) {
        EXPECT_GT(cosine(query, q, reference, q), cosine(query, q, reference, r)) << q << ' ' << r;
      }
}

TEST_F(BlocksOfAStreet, AreMovedByAColumnWhereTheCameraIsTurned) {
  // 80 of 640 pixels are one of 8 columns.
  const BlocksModel model = place::learn_blocks(reference_);
  const ColumnStack reference = place::describe_blocks(reference_, model),
                    turned =
                        place::describe_blocks(records_of(*descriptor_, kPlaces, {.turned_px = 80}), model);
  std::size_t nearer = 0;
  for (std::size_t i = 0; i < kPlaces; ++i)
    nearer += cosine(reference, i, turned, i, 1) > cosine(reference, i, turned, i) ? 1U : 0U;
  EXPECT_EQ(nearer, kPlaces);
}

TEST_F(BlocksOfAStreet, AreTheSameForAnyNumberOfThreads) {
  vo::set_thread_count(1);
  const Bytes one = place::pack_blocks(place::learn_blocks(reference_));
  vo::set_thread_count(4);
  const Bytes four = place::pack_blocks(place::learn_blocks(reference_));
  const ColumnStack described = place::describe_blocks(reference_, place::unpack_blocks(one));
  vo::set_thread_count(1);
  EXPECT_EQ(described.values, place::describe_blocks(reference_, place::unpack_blocks(four)).values);
  vo::set_thread_count(0);
  EXPECT_EQ(one, four);
}

TEST_F(BlocksOfAStreet, ComeBackFromBytes) {
  const BlocksModel model = place::learn_blocks(reference_);
  const BlocksModel back = place::unpack_blocks(place::pack_blocks(model));
  ASSERT_EQ(back.column_axes.axes.values.size(), model.column_axes.axes.values.size());
  // Half precision: 11 bits of numbers below 1. The axes: half of 1/127 of the largest, and that the step has
  // 11 bits itself.
  for (std::size_t i = 0; i < back.block_axes.axes.values.size(); ++i)
    EXPECT_NEAR(back.block_axes.axes.values[i], model.block_axes.axes.values[i], 1.0 / 2048);
  for (std::size_t i = 0; i < back.column_axes.axes.size(); ++i) {
    float largest = 0;
    for (const float value : model.column_axes.axes[i]) largest = std::max(largest, std::abs(value));
    for (std::size_t k = 0; k < back.column_axes.axes.width; ++k)
      EXPECT_NEAR(back.column_axes.axes[i][k], model.column_axes.axes[i][k],
                  largest * (0.51 / 127 + 1.0 / 1024));
  }
}

TEST(Blocks, OfOneKeyframeAreDescribed) {
  const auto descriptor = place::make_blocks({});
  const std::vector<Bytes> one = records_of(*descriptor, 1, {});
  const ColumnStack stack = place::describe_blocks(one, place::learn_blocks(one));
  EXPECT_EQ(stack.size(), 1U);
  EXPECT_NEAR(cosine(stack, 0, stack, 0), 1, 1e-9);
  EXPECT_EQ(place::describe_blocks({}, place::learn_blocks(one)).size(), 0U);
}

TEST(Blocks, OfOneGreyAreNothing) {
  const auto descriptor = place::make_blocks({});
  vo::Frame frame;
  frame.image = cv::Mat(90, 160, CV_8U, cv::Scalar(50));
  const std::vector<Bytes> grey(3, descriptor->record(frame));
  EXPECT_THAT(place::describe_blocks(grey, place::learn_blocks(grey)).values, testing::Each(0));
}

TEST(Blocks, RefuseWhatIsNotTheirs) {
  EXPECT_THROW(place::learn_blocks({}), std::invalid_argument);
  EXPECT_THROW(place::learn_blocks(std::vector<Bytes>{Bytes(7)}), vo::Error);
  EXPECT_THROW(place::unpack_blocks(Bytes{}), vo::Error);
  EXPECT_THROW(place::unpack_blocks(Bytes(100)), vo::Error);
  const auto descriptor = place::make_blocks({});
  Bytes bytes = place::pack_blocks(place::learn_blocks(records_of(*descriptor, 2, {})));
  bytes.pop_back();
  EXPECT_THROW(place::unpack_blocks(bytes), vo::Error);
}

}  // namespace
