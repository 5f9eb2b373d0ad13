#include "place/describe/descriptor.hpp"

#include "place/describe/quantise.hpp"
#include "support/described_views.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using place::make_descriptors;
using test_support::keyframes_of;

TEST(Descriptors, AreMadeByName) {
  for (const std::string name : {"blocks", "hog", "thumbnail"})
    EXPECT_EQ(make_descriptors({.name = name})->size(), 1U);
  EXPECT_EQ(make_descriptors({.name = "blocks+hog"})->size(), 2U);
}

TEST(Descriptors, OfNoSuchNameAreRefused) {
  for (const std::string name : {"", "surf", "blocks+", "+blocks", "Blocks"})
    EXPECT_THROW(make_descriptors({.name = name}), vo::Error) << name;
}

TEST(Descriptors, GiveOneForEachKeyframe) {
  for (const std::string name : {"blocks", "hog", "thumbnail"}) {
    const auto made = make_descriptors({.name = name});
    const place::Descriptor* descriptor = made->front().get();
    const place::KeyframeRecords keyframes = keyframes_of(*descriptor, 3, {});
    EXPECT_EQ(count_of(descriptor->describe(keyframes, descriptor->learn(keyframes))), 3U) << name;
  }
}

TEST(Select, TakesDescriptorsOfAnyForm) {
  const std::vector<std::size_t> indices{2, 0};
  const place::Descriptors rows = place::FloatRows{.width = 2, .values = {1, 2, 3, 4, 5, 6}};
  EXPECT_THAT(std::get<place::FloatRows>(place::select(rows, indices)).values,
              testing::ElementsAre(5, 6, 1, 2));
  place::ColumnStack stack{.columns = 2, .channels = 1, .values = {}};
  stack.values = {1, 2, 3, 4, 5, 6};
  EXPECT_THAT(std::get<place::ColumnStack>(place::select(stack, indices)).values,
              testing::ElementsAre(5, 6, 1, 2));
  EXPECT_THROW(place::select(rows, std::vector<std::size_t>{3}), std::out_of_range);
}

TEST(Descriptors, HaveTheSizeOfTheirForm) {
  EXPECT_EQ(place::bytes_of_each(vo::make_image_stack(4, 2, 3)), 8U);
  EXPECT_EQ(place::bytes_of_each(place::make_column_stack(8, 128, 3)), 1024U);
  EXPECT_EQ(place::bytes_of_each(place::make_float_rows(5, 0)), 20U);  // 4 bytes a value
}

}  // namespace
