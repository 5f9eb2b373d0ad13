#include "place/describe/quantise.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using place::make_column_stack;
using place::quantise;

TEST(Quantise, RoundsToStepsAndCutsWhatIsFar) {
  place::ColumnStack stack = make_column_stack(2, 2, 2);
  quantise(std::vector<float>{0.4F, -0.6F, 1000, -1000}, 0.5F, stack, 1);
  EXPECT_THAT(stack[0], testing::Each(0));
  EXPECT_THAT(stack[1], testing::ElementsAre(1, -1, 63, -63));
}

TEST(Quantise, TheStepPutsFourDeviationsAtTheEnd) {
  EXPECT_FLOAT_EQ(place::quantisation_step(std::vector<float>{3, -3, 3, -3}), 12.0F / 63);
  EXPECT_FLOAT_EQ(place::quantisation_step(std::vector<float>{0, 0}), 1);
  EXPECT_FLOAT_EQ(place::quantisation_step({}), 1);
}

TEST(Quantise, RefusesOtherSizes) {
  place::ColumnStack stack = make_column_stack(2, 2, 1);
  EXPECT_THROW(quantise(std::vector<float>{1}, 1, stack, 0), std::invalid_argument);
  EXPECT_THROW(quantise(std::vector<float>(4), 0, stack, 0), std::invalid_argument);
  EXPECT_THROW(make_column_stack(-1, 2, 1), std::invalid_argument);
  EXPECT_EQ(make_column_stack(8, 128, 0).size(), 0U);
}

}  // namespace
