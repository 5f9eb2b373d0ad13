#include "report/kept_matrices.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

place::Route route_of(std::size_t keyframes) {
  place::Route route;
  route.traverses.emplace_back().keyframes.resize(keyframes);
  return route;
}

std::vector<std::size_t> counted(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

TEST(MatrixKeeper, KeepsTheLeastOfEachCellOfALargeMatrix) {
  constexpr std::size_t kQueries = 40, kReferences = 3 * 1024 - 7;
  place::CostMatrix whole = place::make_cost_matrix(kQueries, kReferences);
  vo::Rng rng(1);
  for (float& value : whole.values) value = static_cast<float>(rng.index(1000));
  const place::Route route = route_of(kReferences);
  retrace::MatrixKeeper small(route, false), all(route, true);
  const auto references = counted(kReferences);
  // In two parts, as a search gives them.
  for (const auto& [first, count] :
       {std::pair<std::size_t, std::size_t>{0, 1000}, {1000, kReferences - 1000}}) {
    const place::SearchPart part{0, true, place::block_of(std::as_const(whole)).columns(first, count),
                                 references};
    small(part);
    all(part);
  }
  ASSERT_EQ(small.matrices().size(), 1U);
  const retrace::KeptMatrix& kept = small.matrices()[0];
  EXPECT_EQ(kept.shrink, 3U);
  ASSERT_EQ(kept.enhanced.queries, 14U);
  ASSERT_EQ(kept.enhanced.references, (kReferences + 2) / 3);
  for (std::size_t row = 0; row < 14; ++row) {
    for (std::size_t column = 0; column < kept.enhanced.references; ++column) {
      float least = 1e9F;
      for (std::size_t q = 3 * row; q < std::min(kQueries, 3 * row + 3); ++q) {
        for (std::size_t r = 3 * column; r < std::min(kReferences, 3 * column + 3); ++r)
          least = std::min(least, whole.at(q, r));
      }
      ASSERT_EQ(kept.enhanced.at(row, column), least);
    }
  }
  EXPECT_EQ(all.matrices()[0].shrink, 1U);
  EXPECT_EQ(all.matrices()[0].enhanced.values, whole.values);
  EXPECT_TRUE(std::isinf(all.matrices()[0].cost.values.front()));  // none of it passed by
}

TEST(MatrixKeeper, PutsAShortlistsColumnsWhereTheyBelong) {
  place::CostMatrix costs = place::make_cost_matrix(1, 2);
  costs.values = {5, 7};
  const place::Route route = route_of(4);
  retrace::MatrixKeeper keeper(route, false);
  const std::vector<std::size_t> references{1, 3};
  keeper({0, false, place::block_of(std::as_const(costs)), references});
  const auto& kept = keeper.matrices()[0].cost;
  EXPECT_EQ(kept.at(0, 1), 5);
  EXPECT_EQ(kept.at(0, 3), 7);
  EXPECT_TRUE(std::isinf(kept.at(0, 0)));
}

}  // namespace
