#include "place/match/team.hpp"

#include "match/messages.hpp"
#include "match/tree_sum.hpp"
#include "support/thread_team.hpp"

#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using place::shards_of;
using place::TreeSum;
using testing::ElementsAre;

TEST(Shards, CoverTheReferenceInBlocksAsEvenAsTheseAllow) {
  for (const std::size_t count : {0U, 1U, 511U, 512U, 513U, 5000U, 100'000U}) {
    for (const std::size_t members : {1U, 2U, 3U, 5U, 8U, 64U}) {
      const auto shards = shards_of(count, members);
      ASSERT_EQ(shards.size(), members);
      std::size_t next = 0, least = count + 1, most = 0;
      for (const place::Shard& shard : shards) {
        EXPECT_EQ(shard.begin, next);
        EXPECT_TRUE(shard.begin % place::kShardBlock == 0 || shard.begin == count);
        next = shard.end;
        least = std::min(least, (shard.size() + 511) / 512);
        most = std::max(most, (shard.size() + 511) / 512);
      }
      EXPECT_EQ(next, count);
      EXPECT_LE(most - least, 1);  // blocks
    }
  }
}

TEST(Shards, OfALargeReferenceAreWithinFivePercentOfEven) {
  const auto shards = shards_of(100'000'000, 64);
  for (const place::Shard& shard : shards)
    EXPECT_NEAR(static_cast<double>(shard.size()), 1e8 / 64, 0.05 * 1e8 / 64);
}

TEST(TreeSum, AddsInPairsAsWorkedOutByHand) {
  // ((a + b) + (c + d)) + e, where 1 is lost beside 1e16 unless two of them meet first.
  TreeSum<double> sum;
  for (const double value : {1e16, 1.0, 1.0, 1.0, 1.0}) sum.add(value);
  EXPECT_EQ(sum.total(), (1e16 + 1.0) + (1.0 + 1.0) + 1.0);
  EXPECT_EQ(TreeSum<double>().total(), 0);
  TreeSum<double> one;
  one.add(0.1);
  EXPECT_EQ(one.total(), 0.1);
}

TEST(TreeSum, IsTheSameHoweverTheBlocksAreDivided) {
  vo::Rng rng(3);
  std::vector<double> blocks(200);
  for (double& block : blocks) block = std::exp(40 * rng.uniform());
  for (std::size_t count = 0; count <= blocks.size(); count += 7) {
    TreeSum<double> whole;
    for (std::size_t i = 0; i < count; ++i) whole.add(blocks[i]);
    for (const std::size_t members : {2U, 3U, 8U, 200U}) {
      TreeSum<double> merged;
      for (std::size_t m = 0; m < members; ++m) {
        TreeSum<double> part(count * m / members);
        for (std::size_t i = count * m / members; i < count * (m + 1) / members; ++i) part.add(blocks[i]);
        for (const auto& node : part.nodes()) merged.append(node);
      }
      EXPECT_EQ(merged.total(), whole.total()) << count << " blocks, " << members << " members";
    }
  }
}

TEST(Teams, ExchangeEveryonesValuesAndCollectThemAtTheFirst) {
  test_support::ThreadTeam::run(3, [](place::Team& team) {
    const std::vector<int> mine(team.rank(), static_cast<int>(team.rank()));
    EXPECT_THAT(place::exchange_all(team, std::span<const int>(mine)),
                ElementsAre(ElementsAre(), ElementsAre(1), ElementsAre(2, 2)));
    const std::vector<std::uint8_t> byte{static_cast<std::uint8_t>(team.rank())};
    EXPECT_EQ(team.collect(byte).size(), team.rank() == 0 ? 3U : 0U);
  });
  place::Alone alone;
  EXPECT_THAT(alone.exchange(std::vector<std::uint8_t>{7}), ElementsAre(ElementsAre(7)));
}

TEST(Messages, ThatAreTooShortAreFound) {
  place::MessageWriter message;
  message.put_all(std::vector<double>{1, 2, 3});
  std::vector<std::uint8_t> bytes = message.bytes();
  EXPECT_THAT(place::MessageReader(bytes).get_all<double>(), ElementsAre(1, 2, 3));
  bytes.pop_back();
  EXPECT_THROW(place::MessageReader(bytes).get_all<double>(), std::logic_error);
}

}  // namespace
