#include "place/evaluation/method_ranks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using place::mean_ranks;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(MethodRanks, AreThoseWorkedOutByHand) {
  // First set: 0.9 > 0.7 > 0.5. Second: two share ranks 1 and 2. Third: one cannot be run.
  EXPECT_THAT(mean_ranks({{0.7, 0.9, 0.5}, {0.8, 0.8, 0.1}, {0.2, std::nullopt, 0.6}}),
              ElementsAre((2 + 1.5 + 2) / 3, (1 + 1.5 + 3) / 3, (3 + 3 + 1) / 3.0));
}

TEST(MethodRanks, AddUpToTheSumOfAllRanksWhateverTies) {
  for (const auto& figures : {std::vector<std::optional<double>>{0.5, 0.5, 0.5, 0.5},
                              std::vector<std::optional<double>>{0.1, {}, 0.1, {}},
                              std::vector<std::optional<double>>{0.4, 0.3, 0.2, 0.1}}) {
    double sum = 0;
    for (const double rank : mean_ranks({figures})) sum += rank;
    EXPECT_DOUBLE_EQ(sum, 10);
  }
}

TEST(MethodRanks, OfNothingOrOneMethod) {
  EXPECT_THAT(mean_ranks({}), IsEmpty());
  EXPECT_THAT(mean_ranks({{0.3}, {std::nullopt}}), ElementsAre(1));
  EXPECT_THROW(mean_ranks({{0.3, 0.2}, {0.1}}), std::invalid_argument);
}

}  // namespace
