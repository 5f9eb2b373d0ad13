#include "describe/learned_bytes.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::Bytes;
using place::FloatRows;
using place::LearnedReader;
using place::LearnedWriter;

TEST(LearnedBytes, OfKnownNumbers) {
  LearnedWriter writer;
  writer.add({.width = 2, .values = {1, -2}});
  // Width 2 and one row in four bytes each, then 1 and -2 as binary16: 0x3c00 and 0xc000.
  EXPECT_THAT(writer.take(), testing::ElementsAre(2, 0, 0, 0, 1, 0, 0, 0, 0x00, 0x3c, 0x00, 0xc0));
}

TEST(LearnedBytes, ComeBackInOrder) {
  vo::Rng rng(2);
  FloatRows fine = place::make_float_rows(7, 5), coarse = place::make_float_rows(9, 4);
  for (FloatRows* rows : {&fine, &coarse})
    for (float& value : rows->values) value = static_cast<float>(rng.uniform(-3, 3));
  for (float& value : coarse[2]) value = 0;  // a row that has no largest value
  LearnedWriter writer;
  writer.add(fine);
  writer.add_coarsely(coarse);
  writer.add({.width = 4, .values = {}});
  const Bytes bytes = writer.take();
  LearnedReader reader(bytes);
  const FloatRows fine_back = reader.next(), coarse_back = reader.next_coarse(), none = reader.next();
  ASSERT_EQ(fine_back.values.size(), fine.values.size());
  // 11 bits of a number below 4; and half of 1/127 of a row's largest, whose step has 11 bits itself.
  for (std::size_t i = 0; i < fine.values.size(); ++i)
    EXPECT_NEAR(fine_back.values[i], fine.values[i], 4.0 / 2048);
  ASSERT_EQ(coarse_back.values.size(), coarse.values.size());
  for (std::size_t i = 0; i < coarse.values.size(); ++i)
    EXPECT_NEAR(coarse_back.values[i], coarse.values[i], 3 * (0.51 / 127 + 1.0 / 1024));
  EXPECT_THAT(coarse_back[2], testing::Each(0.0F));
  EXPECT_EQ(none.width, 4U);
  EXPECT_EQ(none.size(), 0U);
}

TEST(LearnedBytes, ThatBreakOffAreRefused) {
  LearnedWriter writer;
  writer.add({.width = 3, .values = {1, 2, 3}});
  const Bytes bytes = writer.take();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const Bytes part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_THROW(LearnedReader(part).next(), vo::Error) << length;
  }
  EXPECT_THROW(LearnedReader(Bytes(8, 255)).next(), vo::Error);  // more than any memory
}

}  // namespace
