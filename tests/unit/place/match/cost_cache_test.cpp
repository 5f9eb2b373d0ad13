#include "match/cost_cache.hpp"

#include "place/match/cost_matrix.hpp"
#include "support/random_images.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>

namespace {

using test_support::random_images;

constexpr std::size_t kQueries = 9, kReferences = 200;
constexpr float kNeverMade = -7;

/// A matrix, its source, and parts of another matrix in its place to tell what was kept from what is made
/// again.
class CostCacheTest : public testing::Test {
 protected:
  [[nodiscard]] place::ConstCosts changed(std::size_t first, std::size_t count) const {
    return place::block_of(kept_).columns(first, count);
  }

  /// What a cache gives of references [first, past).
  static std::vector<float> fetched(const place::CostCache& cache, std::size_t first, std::size_t past) {
    std::vector<float> values(kQueries * (past - first), kNeverMade);
    cache.fetch({0, kQueries, first, past - first, values.data(), past - first});
    return values;
  }

  /// Columns [first, past), of `kept_` where `is_kept` says so and of the true matrix elsewhere.
  template <typename IsKept>
  [[nodiscard]] std::vector<float> expected(std::size_t first, std::size_t past,
                                            const IsKept& is_kept) const {
    std::vector<float> values;
    for (std::size_t q = 0; q < kQueries; ++q) {
      for (std::size_t r = first; r < past; ++r) values.push_back((is_kept(r) ? kept_ : true_).at(q, r));
    }
    return values;
  }

  vo::ImageStack queries_ = random_images(16, 8, kQueries, 1),
                 references_ = random_images(16, 8, kReferences, 2);
  place::ThumbnailCosts source_{queries_, references_};
  place::CostMatrix true_ = place::cost_matrix(queries_, references_);
  place::CostMatrix kept_ = place::cost_matrix(queries_, random_images(16, 8, kReferences, 3));
};

TEST_F(CostCacheTest, GivesToTheBitWhatItKept) {
  place::CostCache cache(source_, 1 << 20);
  cache.keep(changed(0, kReferences));
  const auto all = [](std::size_t) { return true; };
  EXPECT_EQ(fetched(cache, 0, kReferences), expected(0, kReferences, all));
  EXPECT_EQ(fetched(cache, 33, 34), expected(33, 34, all));
}

TEST_F(CostCacheTest, MakesTheRestAgain) {
  place::CostCache cache(source_, 1 << 20);
  cache.keep(changed(20, 30));
  cache.keep(changed(50, 10));
  cache.keep(changed(90, 40));
  const auto is_kept = [](std::size_t r) { return (r >= 20 && r < 60) || (r >= 90 && r < 130); };
  for (const auto& [first, past] :
       {std::pair<std::size_t, std::size_t>{0, kReferences}, {25, 55}, {40, 100}, {130, 200}, {59, 91}})
    EXPECT_EQ(fetched(cache, first, past), expected(first, past, is_kept)) << first << " to " << past;
}

TEST_F(CostCacheTest, KeepsWhatThereIsRoomFor) {
  // Room for 100 references of all queries.
  place::CostCache cache(source_, kQueries * 100 * sizeof(std::uint16_t));
  cache.keep(changed(0, 80));
  cache.keep(changed(80, 40));   // too many
  cache.keep(changed(120, 20));  // just right
  cache.keep(changed(140, 1));
  const auto is_kept = [](std::size_t r) { return r < 80 || (r >= 120 && r < 140); };
  EXPECT_EQ(fetched(cache, 0, kReferences), expected(0, kReferences, is_kept));
}

TEST_F(CostCacheTest, DoesNotKeepWhatSixteenBitsDoNotHold) {
  const float unit = source_.unit();
  const auto none = [](std::size_t) { return false; };
  for (const float units : {65535.0F, 65536.0F, 3e6F, std::numeric_limits<float>::infinity()}) {
    place::CostMatrix wide = kept_;
    std::ranges::fill(wide.values, 0.0F);
    wide.row(4)[60] = units * unit;
    place::CostCache cache(source_, 1 << 20);
    cache.keep(place::block_of(wide));
    if (units == 65535.0F) {
      EXPECT_EQ(fetched(cache, 0, kReferences), wide.values);
    } else {
      EXPECT_EQ(fetched(cache, 0, kReferences), expected(0, kReferences, none)) << units;
    }
  }
  // Nor costs that are all beyond what floats tell apart.
  place::CostMatrix large = kept_;
  std::ranges::fill(large.values, 2e6F * unit);
  place::CostCache cache(source_, 1 << 20);
  cache.keep(place::block_of(large));
  EXPECT_EQ(fetched(cache, 0, kReferences), expected(0, kReferences, none));
}

TEST_F(CostCacheTest, IsTheSameForAnyThreadCount) {
  std::vector<std::vector<float>> values;
  for (const int threads : {1, 4}) {
    vo::set_thread_count(threads);
    place::CostCache cache(source_, 1 << 20);
    cache.keep(changed(0, 100));
    values.push_back(fetched(cache, 0, kReferences));
  }
  vo::set_thread_count(0);
  EXPECT_EQ(values[0], values[1]);
}

}  // namespace
