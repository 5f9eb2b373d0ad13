#include "match/part_searches.hpp"

#include "certainty/part_certainty.hpp"
#include "support/drawn_costs.hpp"
#include "support/thread_team.hpp"

#include <cmath>
#include <mutex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/contrast_enhancement.hpp>
#include <place/match/summed_costs.hpp>

/// A team finds what one does who has the whole matrix, to the bit.
namespace {

using place::CostMatrix;
using place::MatrixPart;
using place::SearchOptions;
using place::Shard;
using test_support::ThreadTeam;

constexpr std::size_t kReferences = 9 * place::kShardBlock + 100;

/// A part of a matrix: a shard and `margin` references beside it.
struct OwnPart {
  CostMatrix costs;
  std::size_t first = 0;
  Shard own;
};

OwnPart part_of(const CostMatrix& whole, const place::Team& team, std::size_t margin) {
  OwnPart part;
  part.own = place::shards_of(whole.references, team.size())[team.rank()];
  part.first = part.own.begin - std::min(part.own.begin, margin);
  const std::size_t past = std::min(whole.references, part.own.end + margin);
  part.costs = place::make_cost_matrix(whole.queries, past - part.first);
  for (std::size_t q = 0; q < whole.queries; ++q)
    std::ranges::copy(whole.row(q).subspan(part.first, past - part.first), part.costs.row(q).begin());
  return part;
}

MatrixPart matrix_of(const OwnPart& part, std::size_t references) {
  return {part.costs, part.first, part.own, references};
}

/// Real-valued costs with a walk that crosses the borders of several shards.
CostMatrix walked(std::size_t queries, std::size_t references, double first, double speed,
                  std::uint64_t seed) {
  CostMatrix costs = test_support::walked_costs(queries, references, first, speed, 3.0F, seed);
  vo::Rng rng(seed);
  for (float& cost : costs.values) cost += static_cast<float>(0.3 * rng.normal());
  return costs;
}

void expect_same(const std::vector<place::SureMatch>& a, const std::vector<place::SureMatch>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t q = 0; q < a.size(); ++q) {
    EXPECT_TRUE(test_support::same(a[q].match, b[q].match)) << q;
    EXPECT_EQ(a[q].probability, b[q].probability) << q;
    EXPECT_EQ(a[q].sd_keyframes, b[q].sd_keyframes) << q;
  }
}

/// Teams of several sizes get what `search_surely` gets from the whole.
void expect_the_whole(const CostMatrix& whole, const char* name, const SearchOptions& options,
                      std::size_t margin) {
  const place::SearchMethod& method = place::search_method(name);
  const place::SureMatches expected = place::search_surely(whole, method, options);
  for (const std::size_t members : {1U, 2U, 3U, 5U, 8U, 12U}) {
    SCOPED_TRACE(members);
    std::mutex mutex;
    ThreadTeam::run(members, [&](place::Team& team) {
      const OwnPart part = part_of(whole, team, margin);
      const place::SureMatches found =
          place::search_surely_part(matrix_of(part, whole.references), method, options, team);
      const std::scoped_lock lock(mutex);
      expect_same(found.matches, expected.matches);
      EXPECT_EQ(found.wrong_share, expected.wrong_share);
    });
  }
}

TEST(PartSearches, FindAPathThatCrossesBorders) {
  // From the first shard of any team into the third of eight.
  expect_the_whole(walked(60, kReferences, 470, 12.0, 1), "path", {}, 32);
  expect_the_whole(walked(60, kReferences, 990, 1.0, 2), "path", {}, 32);
}

TEST(PartSearches, FindAPathByStepsThatReachFurtherThanAShard) {
  SearchOptions options;
  for (int q = 0; q < 40; ++q) options.path.steps.push_back(q % 7 == 3 ? 900 : 1.3);
  expect_the_whole(walked(40, kReferences, 10, 60, 3), "path", options, 32);
}

TEST(PartSearches, FindAPathWithGapsAtBordersAndElsewhere) {
  SearchOptions options;
  options.gaps.query = {7, 31};
  options.gaps.reference = {3, 512, 1023, 2000, kReferences - 2};
  expect_the_whole(walked(50, kReferences, 500, 1.0, 4), "path", options, 32);
  options.sequence.uniqueness_window = 700;  // wider than a shard of many
  expect_the_whole(walked(50, kReferences, 500, 20.0, 5), "path", options, 732);
}

TEST(PartSearches, FindLinesThatCrossBorders) {
  SearchOptions options;
  options.sequence = {.length = 20, .search_range_rad = 0.4};
  expect_the_whole(walked(60, kReferences, 490, 1.2, 6), "lines", options, 128);
  options.sequence.score = place::MatchScore::kRatio;
  options.sequence.min_fraction = 1;
  expect_the_whole(walked(60, kReferences, 1010, 0.9, 7), "lines", options, 128);
}

TEST(PartSearches, CompareLinesWithinAWindowAcrossABorder) {
  // Each query's best and its nearest rival lie on either side of the border at 512, inside the window for
  // some queries, outside it for others.
  CostMatrix costs = test_support::chance_costs(40, kReferences, 8);
  for (std::size_t q = 0; q < 40; ++q) {
    costs.row(q)[505 + q / 4] -= 10;
    costs.row(q)[505 + q / 4 + 8 + q % 5] -= 5;
  }
  SearchOptions options;
  options.sequence = {.length = 1, .search_range_rad = 0, .min_fraction = 1, .uniqueness_window = 10};
  expect_the_whole(costs, "lines", options, 64);
  const auto found = place::search_method("lines").search(costs, options).matches;
  for (std::size_t q = 0; q < 40; ++q) EXPECT_EQ(found[q].reference, 505 + q / 4);
}

TEST(PartSearches, FindLinesBetweenGapsThatAreNoMultiplesOfAnything) {
  SearchOptions options;
  options.sequence = {.length = 10, .search_range_rad = 0.2, .uniqueness_window = 50};
  options.gaps.query = {13};
  options.gaps.reference = {5, 509, 515, 1500, 1503, 4000};
  expect_the_whole(walked(50, kReferences, 480, 1.0, 9), "lines", options, 160);
}

TEST(PartSearches, OfNothingOneQueryAndConstantCosts) {
  for (const char* name : {"path", "lines"}) {
    expect_the_whole(place::make_cost_matrix(0, 600), name, {}, 32);
    expect_the_whole(place::make_cost_matrix(3, 1), name, {}, 32);
    expect_the_whole(place::make_cost_matrix(20, 1100), name, {}, 32);
    expect_the_whole(walked(1, 1100, 600, 1, 10), name, {}, 32);
  }
}

TEST(PartSearches, RefuseMethodsThatNeedTheWhole) {
  const CostMatrix costs = test_support::chance_costs(5, 20, 1);
  place::Alone alone;
  for (const place::SearchMethod& method : place::search_methods()) {
    if (method.search_part != nullptr) continue;
    EXPECT_THROW(place::search_surely_part(place::whole_of(costs), method, {}, alone), std::invalid_argument);
  }
}

/// Costs whose sums depend on their order.
CostMatrix raw_costs(std::size_t queries, std::size_t references, std::uint64_t seed) {
  CostMatrix costs = place::make_cost_matrix(queries, references);
  vo::Rng rng(seed);
  for (float& cost : costs.values) cost = static_cast<float>(std::exp(rng.normal()));
  return costs;
}

class PartEnhancement : public testing::TestWithParam<std::size_t> {};
// The last: a single block, so that one member has all and the others nothing.
INSTANTIATE_TEST_SUITE_P(References, PartEnhancement, testing::Values(kReferences, 600, 81));

TEST_P(PartEnhancement, GivesTheValuesOfTheWhole) {
  const CostMatrix raw = raw_costs(17, GetParam(), 11);
  for (const place::Enhancement how : {place::Enhancement::kStandardise, place::Enhancement::kLocal}) {
    const place::ContrastEnhancementOptions options{.method = how, .window = 10, .prior_queries = 30};
    CostMatrix whole = raw;
    place::enhance_contrast(whole, options);
    for (const std::size_t members : {1U, 2U, 3U, 5U, 8U, 12U}) {
      std::mutex mutex;
      ThreadTeam::run(members, [&](place::Team& team) {
        OwnPart part = part_of(raw, team, 64);
        place::ContrastEnhancer enhancer(raw.queries, raw.references, options, part.own, part.first);
        const auto own =
            block_of(std::as_const(part.costs)).columns(part.own.begin - part.first, part.own.size());
        if (how == place::Enhancement::kStandardise) enhancer.survey(own, own.references);
        enhancer.share(team);
        enhancer.enhance(block_of(part.costs));
        const std::scoped_lock lock(mutex);
        for (std::size_t q = 0; q < raw.queries; ++q) {
          const auto found = part.costs.row(q).subspan(part.own.begin - part.first, part.own.size());
          const auto expected = whole.row(q).subspan(part.own.begin, part.own.size());
          EXPECT_TRUE(std::ranges::equal(found, expected)) << members << " members, query " << q;
        }
      });
    }
  }
}

/// The columns of a matrix from one on.
class Given final : public place::CostSource {
 public:
  explicit Given(CostMatrix costs) : costs_(std::move(costs)) {}
  [[nodiscard]] std::size_t queries() const override { return costs_.queries; }
  [[nodiscard]] std::size_t references() const override { return costs_.references; }
  [[nodiscard]] float unit() const override { return 1; }
  void compute(const place::Costs& block) const override {
    for (std::size_t q = 0; q < block.queries; ++q)
      std::ranges::copy(costs_.row(block.first_query + q).subspan(block.first_reference, block.references),
                        block.row(q).begin());
  }

 private:
  CostMatrix costs_;
};

TEST_P(PartEnhancement, SumsStandardisedMatricesAsOfTheWhole) {
  const CostMatrix one = raw_costs(9, GetParam(), 12), other = raw_costs(9, GetParam(), 13);
  const auto parts = [](CostMatrix a, CostMatrix b) {
    std::vector<place::SummedPart> both;
    both.push_back({std::make_unique<Given>(std::move(a)), 0});
    both.push_back({std::make_unique<Given>(std::move(b)), 20});
    return both;
  };
  const CostMatrix whole = place::cost_matrix(place::SummedCosts(parts(one, other)));
  for (const std::size_t members : {2U, 5U}) {
    std::mutex mutex;
    ThreadTeam::run(members, [&](place::Team& team) {
      const OwnPart a = part_of(one, team, 32), b = part_of(other, team, 32);
      const place::SummedCosts summed(parts(a.costs, b.costs), one.references, a.own, a.first, team);
      const CostMatrix part = place::cost_matrix(summed);
      const std::scoped_lock lock(mutex);
      for (std::size_t q = 0; q < part.queries; ++q)
        EXPECT_TRUE(std::ranges::equal(part.row(q), whole.row(q).subspan(a.first, part.references)));
    });
  }
}

}  // namespace
