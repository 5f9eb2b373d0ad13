#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/openseqslam.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

namespace oss = place::openseqslam;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

/// Costs of `background` with `value` at each (query, reference) pair given.
place::CostMatrix costs_with(std::size_t queries, std::size_t references, float background,
                             const std::vector<std::pair<std::size_t, std::size_t>>& pairs, float value) {
  place::CostMatrix costs = place::make_cost_matrix(queries, references);
  for (float& cost : costs.values) cost = background;
  for (const auto& [q, r] : pairs) costs.row(q)[r] = value;
  return costs;
}

TEST(OpenSeqSlamPatchNormalise, WorkedExample) {
  // Mean 4, sample deviation sqrt(16 / 3) = 2.31: -0.87 and +0.87 round to -1 and +1.
  const vo::ImageStack image{.width = 2, .height = 2, .pixels = {2, 6, 2, 6}};
  EXPECT_THAT(oss::patch_normalise(image, {.patch_px = 2}).pixels, ElementsAre(126, 128, 126, 128));
  // Mean 3, sample deviation 6: -0.5 and 1.5 are halves, rounded away from zero.
  const vo::ImageStack halves{.width = 2, .height = 2, .pixels = {0, 0, 0, 12}};
  EXPECT_THAT(oss::patch_normalise(halves, {.patch_px = 2}).pixels, ElementsAre(126, 126, 126, 129));
}

TEST(OpenSeqSlamPatchNormalise, NormalisesEachPatchByItself) {
  const vo::ImageStack image{.width = 4, .height = 2, .pixels = {2, 6, 102, 106, 2, 6, 102, 106}};
  EXPECT_THAT(oss::patch_normalise(image, {.patch_px = 2}).pixels,
              ElementsAre(126, 128, 126, 128, 126, 128, 126, 128));
}

TEST(OpenSeqSlamQuirks, AConstantPatchIsNeutralOrZero) {
  const vo::ImageStack image{.width = 4, .height = 2, .pixels = {9, 9, 2, 6, 9, 9, 2, 6}};
  EXPECT_THAT(oss::patch_normalise(image, {.patch_px = 2}).pixels,
              ElementsAre(127, 127, 126, 128, 127, 127, 126, 128));
  EXPECT_THAT(oss::patch_normalise(image, {.patch_px = 2, .quirks = {.constant_patch_is_zero = true}}).pixels,
              ElementsAre(0, 0, 126, 128, 0, 0, 126, 128));
}

TEST(OpenSeqSlamPatchNormalise, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(oss::patch_normalise(vo::make_image_stack(12, 8, 1), {}), std::invalid_argument);
  EXPECT_THROW(oss::patch_normalise(vo::make_image_stack(8, 12, 1), {}), std::invalid_argument);
  EXPECT_THROW(oss::patch_normalise(vo::make_image_stack(8, 8, 1), {.patch_px = 1}), std::invalid_argument);
  EXPECT_TRUE(oss::patch_normalise(vo::make_image_stack(8, 8, 0), {}).empty());
}

TEST(OpenSeqSlamQuirks, TheDifferenceIsPerPixelOrPerReference) {
  // Sums 1 + 3 and 0 + 4 and 10 + 10, over 2 pixels or 3 references.
  const vo::ImageStack query{.width = 2, .height = 1, .pixels = {100, 100}};
  const vo::ImageStack references{.width = 2, .height = 1, .pixels = {101, 103, 100, 104, 90, 110}};
  EXPECT_THAT(oss::difference_matrix(query, references, {}).values, ElementsAre(2, 2, 10));
  EXPECT_THAT(
      oss::difference_matrix(query, references, {.quirks = {.divides_by_reference_count = true}}).values,
      ElementsAre(4.0F / 3, 4.0F / 3, 20.0F / 3));
  EXPECT_THROW(oss::difference_matrix(vo::make_image_stack(2, 1, 1), vo::make_image_stack(1, 2, 1), {}),
               std::invalid_argument);
}

TEST(OpenSeqSlamEnhance, WorkedExample) {
  // Window 2: {1, 3} -> -1/sqrt 2; {1, 3, 8} -> -1/sqrt 13; {3, 8} -> +1/sqrt 2. Less the smallest, the
  // first.
  const place::CostMatrix differences{.queries = 1, .references = 3, .values = {1, 3, 8}};
  const auto enhanced = oss::enhance(differences, {.enhancement_window = 2});
  EXPECT_EQ(enhanced.values[0], 0);
  EXPECT_NEAR(enhanced.values[1], -1 / std::sqrt(13.0) + 1 / std::sqrt(2.0), 1e-6);  // float rounding
  EXPECT_NEAR(enhanced.values[2], 2 / std::sqrt(2.0), 1e-6);
}

TEST(OpenSeqSlamEnhance, HasNoValueWithoutDeviation) {
  // The window of the last two is constant; of the others it is not.
  const place::CostMatrix differences{.queries = 1, .references = 5, .values = {1, 5, 5, 5, 5}};
  const auto enhanced = oss::enhance(differences, {.enhancement_window = 2});
  EXPECT_FALSE(std::isnan(enhanced.values[0]));
  EXPECT_FALSE(std::isnan(enhanced.values[1]));
  for (std::size_t r = 2; r < 5; ++r) EXPECT_TRUE(std::isnan(enhanced.values[r])) << r;
  // One reference.
  EXPECT_TRUE(std::isnan(oss::enhance(place::make_cost_matrix(1, 1), {}).values[0]));
  EXPECT_THAT(oss::enhance(place::make_cost_matrix(0, 5), {}).values, IsEmpty());
}

/// A line of velocity 1/2 through 10 queries: references 3, 3, 4, 4, 5 ...; length 4, so lines start two
/// queries before the matched one.
class OpenSeqSlamLine : public testing::Test {
 protected:
  OpenSeqSlamLine() {
    options_ = {.sequence_length = 4, .v_min = 0.5, .v_max = 0.5, .match_window = 2, .quirks = {}};
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t q = 0; q < 10; ++q) pairs.emplace_back(q, 3 + q / 2);
    costs_ = costs_with(10, 30, 1, pairs, 0.25F);
  }
  place::CostMatrix costs_;
  oss::Options options_;
};

TEST_F(OpenSeqSlamLine, TheMatchIsWhereTheLinePassesTheQueryOrNot) {
  // At query 4 the line starts at query 2, reference 4: 4, 4, 5, 5. It passes the query at its third term, 5.
  // The original adds half the length to the start: 6.
  EXPECT_EQ(oss::find_matches(costs_, options_)[4].reference, 5U);
  options_.quirks.centre_ignores_velocity = true;
  EXPECT_EQ(oss::find_matches(costs_, options_)[4].reference, 6U);
}

TEST_F(OpenSeqSlamLine, AddsAsManyTermsAsItIsLongOrOneMore) {
  // Best: 4 terms of 0.25. Elsewhere: lines of 1s, 4 in all; with one term more 5 * 0.25 and 5. The same
  // ratio, but a planted background value at the fifth term tells them apart.
  costs_.row(6)[6] = 2;  // the fifth term of the line of query 4: start 4 + floor(4 / 2)
  EXPECT_FLOAT_EQ(oss::find_matches(costs_, options_)[4].score, 1.0F / 4);
  options_.quirks.one_term_too_many = true;
  EXPECT_FLOAT_EQ(oss::find_matches(costs_, options_)[4].score, 3.0F / 5);
}

TEST_F(OpenSeqSlamLine, LeavesTheFirstAndLastHalfSequenceWithoutMatch) {
  const auto matches = oss::find_matches(costs_, options_);
  ASSERT_EQ(matches.size(), 10U);
  for (std::size_t q = 0; q < 10; ++q) EXPECT_EQ(matches[q].reference.has_value(), q >= 2 && q < 8) << q;
  EXPECT_EQ(matches[0].score, 0);
}

TEST_F(OpenSeqSlamLine, AnOddLengthIsMadeEven) {
  const auto even = oss::find_matches(costs_, options_);
  options_.sequence_length = 3;
  const auto odd = oss::find_matches(costs_, options_);
  for (std::size_t q = 0; q < 10; ++q) {
    EXPECT_EQ(odd[q].reference, even[q].reference);
    EXPECT_EQ(odd[q].score, even[q].score);
  }
  options_.sequence_length = 0;
  EXPECT_THROW(oss::find_matches(costs_, options_), std::invalid_argument);
}

TEST_F(OpenSeqSlamLine, StaysInsideTheReferences) {
  // Four references hold a line at velocity 1/2 (0, 0, 1, 1) up to start 2, here the best of query 4.
  const auto short_reference = costs_with(10, 4, 1, {{2, 2}, {3, 2}, {4, 3}, {5, 3}}, 0);
  EXPECT_EQ(oss::find_matches(short_reference, options_)[4].reference, 3U);
  // The original's centre would be start 2 + 2, one past the last.
  options_.quirks.centre_ignores_velocity = true;
  EXPECT_EQ(oss::find_matches(short_reference, options_)[4].reference, 3U);
  // At velocity 2 (0, 2, 4, 6) no line fits into 6.
  options_.v_min = options_.v_max = 2;
  for (const auto& match : oss::find_matches(costs_with(10, 6, 1, {}, 0), options_))
    EXPECT_FALSE(match.reference);
}

TEST_F(OpenSeqSlamLine, IgnoresLinesThroughNoValue) {
  for (std::size_t q = 0; q < 10; ++q) costs_.row(q)[4] = std::nanf("");
  const auto matches = oss::find_matches(costs_, options_);
  for (std::size_t q = 2; q < 8; ++q) {
    ASSERT_TRUE(matches[q].reference);
    EXPECT_FALSE(std::isnan(matches[q].score));
  }
  const auto nothing = oss::find_matches(costs_with(10, 30, std::nanf(""), {}, 0), options_);
  for (const auto& match : nothing) EXPECT_FALSE(match.reference);
}

TEST(OpenSeqSlamFindMatches, EqualsABruteForceSearch) {
  vo::Rng rng(3);
  place::CostMatrix costs = place::make_cost_matrix(30, 50);
  // Multiples of 1/64, whose sums are exact in any order.
  for (float& cost : costs.values) cost = static_cast<float>(1 + rng.index(256)) / 64;
  const oss::Options options{
      .sequence_length = 10, .v_min = 0.8, .v_max = 1.2, .match_window = 10, .quirks = {}};
  const auto matches = oss::find_matches(costs, options);
  for (int q = 0; q < 30; ++q) {
    SCOPED_TRACE(q);
    const auto& match = matches[static_cast<std::size_t>(q)];
    if (q < 5 || q >= 25) {
      EXPECT_FALSE(match.reference);
      continue;
    }
    std::vector<float> best_from(50, 1e9F);
    std::vector<int> centre(50);
    for (int start = 0; start < 50; ++start) {
      for (const int tenths : {8, 9, 10, 11, 12}) {
        float sum = 0;
        for (int k = 0; k < 10; ++k) {
          const int r = start + k * tenths / 10;
          sum += r < 50 ? costs.at(static_cast<std::size_t>(q - 5 + k), static_cast<std::size_t>(r)) : 1e9F;
        }
        if (sum >= best_from[static_cast<std::size_t>(start)]) continue;
        best_from[static_cast<std::size_t>(start)] = sum;
        centre[static_cast<std::size_t>(start)] = start + 5 * tenths / 10;
      }
    }
    const auto best = std::ranges::min_element(best_from) - best_from.begin();
    float second = 1e9F;
    for (int start = 0; start < 50; ++start) {
      if (std::abs(start - best) > 5) second = std::min(second, best_from[static_cast<std::size_t>(start)]);
    }
    EXPECT_EQ(match.reference, static_cast<std::size_t>(centre[static_cast<std::size_t>(best)]));
    EXPECT_FLOAT_EQ(match.score, best_from[static_cast<std::size_t>(best)] / second);
  }
}

TEST(OpenSeqSlam, QuirksOfTheOriginalAreAllOfThem) {
  const auto quirks = oss::Quirks::original();
  EXPECT_TRUE(quirks.constant_patch_is_zero && quirks.divides_by_reference_count &&
              quirks.centre_ignores_velocity && quirks.one_term_too_many);
  const oss::Quirks none;
  EXPECT_FALSE(none.constant_patch_is_zero || none.divides_by_reference_count ||
               none.centre_ignores_velocity || none.one_term_too_many);
}

TEST(OpenSeqSlam, IsTheSameForAnyThreadCount) {
  vo::Rng rng(4);
  place::CostMatrix costs = place::make_cost_matrix(40, 60);
  for (float& cost : costs.values) cost = static_cast<float>(rng.uniform());
  vo::set_thread_count(1);
  const auto one = oss::enhance(costs, {});
  const auto one_matches = oss::find_matches(one, {});
  vo::set_thread_count(4);
  EXPECT_EQ(oss::enhance(costs, {}).values, one.values);
  const auto four_matches = oss::find_matches(one, {});
  vo::set_thread_count(0);
  for (std::size_t q = 0; q < 40; ++q) {
    EXPECT_EQ(four_matches[q].reference, one_matches[q].reference);
    EXPECT_EQ(four_matches[q].score, one_matches[q].score);
  }
}

}  // namespace
