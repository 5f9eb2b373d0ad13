#include <algorithm>
#include <span>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/costs.hpp>

namespace {

using testing::ElementsAre;

/// Costs q + r / 4 of query q and reference r.
class Sums final : public place::CostSource {
 public:
  [[nodiscard]] std::size_t queries() const override { return 3; }
  [[nodiscard]] std::size_t references() const override { return 2; }
  [[nodiscard]] float unit() const override { return 0.25F; }
  void compute(const place::Costs& block) const override {
    for (std::size_t i = 0; i < block.queries; ++i) {
      for (std::size_t j = 0; j < block.references; ++j) {
        block.row(i)[j] =
            static_cast<float>(block.first_query + i) + static_cast<float>(block.first_reference + j) / 4;
      }
    }
  }
};

TEST(CostMatrix, HoldsAllOfASource) {
  const place::CostMatrix matrix = cost_matrix(Sums{});
  EXPECT_EQ(matrix.queries, 3U);
  EXPECT_EQ(matrix.references, 2U);
  EXPECT_THAT(matrix.values, ElementsAre(0, 0.25F, 1, 1.25F, 2, 2.25F));
  EXPECT_THAT(matrix.row(1), ElementsAre(1, 1.25F));
  EXPECT_EQ(matrix.at(2, 1), 2.25F);
}

TEST(CostView, LooksAtMemoryWhereItIs) {
  std::vector<float> values{1, 2, 3, 4, 5, 6};
  const place::CostView view{2, 3, values};
  values[4] = 7;
  EXPECT_EQ(view.at(1, 1), 7);
  EXPECT_THAT(view.row(1), ElementsAre(4, 7, 6));
  place::CostMatrix matrix = cost_matrix(Sums{});
  const place::CostView of_matrix = matrix;
  matrix.row(2)[0] = 9;
  EXPECT_THAT(of_matrix.row(2), ElementsAre(9, 2.25F));
  EXPECT_EQ(block_of(view).values, values.data());
}

TEST(CostBlock, GivesColumnsOfItself) {
  place::CostMatrix matrix = cost_matrix(Sums{});
  const place::Costs last = block_of(matrix).columns(1, 1);
  EXPECT_EQ(last.first_reference, 1U);
  EXPECT_EQ(last.queries, 3U);
  EXPECT_THAT(last.row(2), ElementsAre(2.25F));
}

TEST(RangeOf, IsTheMeanAndTheFurthestFromIt) {
  EXPECT_EQ(place::range_of({}).largest, 0);
  const std::vector<float> one{7};
  EXPECT_EQ(place::range_of(one).centre, 7);
  EXPECT_EQ(place::range_of(one).largest, 0);
  std::vector<float> many(19, 1.0F);  // more than twice what is taken together
  many[3] = 20;
  many[17] = -1;
  const place::CostRange range = place::range_of(many);
  EXPECT_DOUBLE_EQ(range.centre, (17 + 20 - 1) / 19.0);
  EXPECT_DOUBLE_EQ(range.largest, 20 - 36 / 19.0);
  std::ranges::fill(many, 4.0F);
  EXPECT_EQ(place::range_of(many).largest, 0);
}

}  // namespace
