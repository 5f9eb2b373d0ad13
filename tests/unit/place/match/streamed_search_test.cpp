#include "support/random_columns.hpp"
#include "support/random_images.hpp"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/shifted_cosine.hpp>
#include <place/match/streamed_search.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::Enhancement;
using test_support::random_columns;
using test_support::random_images;

constexpr Enhancement kMethods[] = {Enhancement::kNone, Enhancement::kLocal, Enhancement::kStandardise};

/// A walk of random views, and the stretch of it from `first` on again, each pixel a little off.
struct Walks {
  Walks(std::size_t queries, std::size_t references, std::size_t first)
      : reference(random_images(8, 4, references, 1)), query(random_images(8, 4, queries, 2)) {
    for (std::size_t q = 0; q < queries; ++q) {
      for (std::size_t k = 0; k < query.image_size(); ++k)
        query[q][k] = static_cast<std::uint8_t>((query[q][k] + 3 * reference[first + q][k]) / 4);
    }
  }
  vo::ImageStack reference, query;
};

TEST(SearchStreamed, IsTheThreeStagesOneAfterTheOther) {
  // More references than a part has, whether all of their costs are kept, some or none.
  static constexpr std::size_t kQueries = 130, kReferences = 8192 + 300;
  const Walks walks(kQueries, kReferences, 8100);
  for (const Enhancement method : kMethods) {
    for (const int shift : {0, 1}) {
      place::StreamedSearchOptions options{.cost = {.max_shift_px = shift},
                                           .enhancement = {.method = method}};
      auto matrix = place::cost_matrix(walks.query, walks.reference, options.cost);
      const auto raw = matrix;
      place::enhance_contrast(matrix, options.enhancement);
      const auto expected = place::search_sequences(matrix, options.search);
      for (const std::size_t kept :
           {std::size_t{0}, kQueries * 500 * sizeof(std::uint16_t), std::size_t{1} << 30U}) {
        SCOPED_TRACE(testing::Message()
                     << static_cast<int>(method) << ", shift " << shift << ", kept " << kept);
        options.kept_bytes = kept;
        std::size_t costs_seen = 0, enhanced_seen = 0;
        const auto sees = [](const place::CostMatrix& whole, std::size_t& next) {
          return [&whole, &next](const place::ConstCosts& part) {
            ASSERT_EQ(part.first_reference, next);
            ASSERT_EQ(part.queries, kQueries);
            for (std::size_t q = 0; q < kQueries; ++q)
              ASSERT_TRUE(std::ranges::equal(part.row(q), whole.row(q).subspan(next, part.references)));
            next += part.references;
          };
        };
        const auto found = place::search_streamed(walks.query, walks.reference, options,
                                                  {sees(raw, costs_seen), sees(matrix, enhanced_seen)});
        EXPECT_EQ(costs_seen, kReferences);
        EXPECT_EQ(enhanced_seen, kReferences);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t q = 0; q < found.size(); ++q) {
          EXPECT_EQ(found[q].reference, expected[q].reference) << q;
          // The searcher rounds costs of up to 12 deviations in tens at 2^-22.
          EXPECT_NEAR(found[q].cost, expected[q].cost, 1e-6) << q;
          EXPECT_NEAR(found[q].score, expected[q].score, 2e-6) << q;
          EXPECT_EQ(found[q].terms, expected[q].terms) << q;
        }
        EXPECT_EQ(found[115].reference, 8215U);  // and it is the right place
      }
    }
  }
}

TEST(SearchStreamed, TakesCostsOfAnySource) {
  static constexpr std::size_t kQueries = 60, kReferences = 900, kFirst = 700;
  const auto references = random_columns(8, 4, kReferences, 63, 1);
  auto queries = random_columns(8, 4, kQueries, 10, 2);  // the stretch again, a little off
  for (std::size_t i = 0; i < queries.values.size(); ++i) {
    const int there = references.values[kFirst * references.descriptor_size() + i];
    queries.values[i] = static_cast<std::int8_t>((3 * there + queries.values[i]) / 4);
  }
  const place::ShiftedCosine source(queries, references);
  auto matrix = cost_matrix(source);
  const place::StreamedSearchOptions options;
  place::enhance_contrast(matrix, options.enhancement);
  const auto expected = place::search_sequences(matrix, options.search);
  for (const std::size_t kept : {std::size_t{0}, std::size_t{1} << 20U}) {
    place::StreamedSearchOptions keeping = options;
    keeping.kept_bytes = kept;
    const auto found = place::search_streamed(source, keeping);
    for (std::size_t q = 0; q < kQueries; ++q) {
      EXPECT_EQ(found[q].reference, expected[q].reference) << q;
      EXPECT_NEAR(found[q].cost, expected[q].cost, 1e-6) << q;
    }
    EXPECT_EQ(found[30].reference, kFirst + 30);
  }
}

TEST(SearchStreamed, GivesLinesAllThatTheyReach) {
  // Lines that reach just as far as a part's margins are aligned, and a little further.
  const Walks walks(130, 8192 + 300, 8150);
  for (const int length : {64, 66}) {
    const place::StreamedSearchOptions options{.enhancement = {.method = Enhancement::kLocal},
                                               .search = {.length = length, .search_range_rad = 0}};
    auto matrix = place::cost_matrix(walks.query, walks.reference);
    place::enhance_contrast(matrix, options.enhancement);
    const auto expected = place::search_sequences(matrix, options.search);
    const auto found = place::search_streamed(walks.query, walks.reference, options);
    for (std::size_t q = 0; q < found.size(); ++q) {
      EXPECT_EQ(found[q].reference, expected[q].reference) << q;
      EXPECT_NEAR(found[q].cost, expected[q].cost, 1e-6) << q;
    }
    EXPECT_EQ(found[42].reference, 8192U);
  }
}

TEST(SearchStreamed, OfNothingFindsNothing) {
  const auto none = random_images(8, 4, 0, 1), some = random_images(8, 4, 3, 1);
  for (const Enhancement method : kMethods) {
    const place::StreamedSearchOptions options{.enhancement = {.method = method}};
    EXPECT_TRUE(place::search_streamed(none, some, options).empty());
    EXPECT_EQ(place::search_streamed(some, none, options).size(), 3U);
    EXPECT_TRUE(place::search_streamed(none, none, options).empty());
    EXPECT_EQ(place::search_streamed(some, some, options).size(), 3U);
  }
}

TEST(SearchStreamed, RefusesOptionsThatAreNotValid) {
  const auto images = random_images(8, 4, 3, 1);
  EXPECT_THROW(place::search_streamed(images, images, {.search = {.length = 0}}), std::invalid_argument);
  EXPECT_THROW(place::search_streamed(images, images, {.enhancement = {.window = 1}}), std::invalid_argument);
  EXPECT_THROW(place::search_streamed(images, images, {.cost = {.max_shift_px = 8}}), std::invalid_argument);
}

TEST(SearchStreamed, IsTheSameForAnyThreadCount) {
  const Walks walks(120, 300, 50);
  const auto run = [&](int threads) {
    vo::set_thread_count(threads);
    return place::search_streamed(walks.query, walks.reference, {});
  };
  const auto one = run(1), four = run(4);
  vo::set_thread_count(0);
  for (std::size_t q = 0; q < one.size(); ++q) {
    EXPECT_EQ(one[q].reference, four[q].reference);
    EXPECT_EQ(one[q].cost, four[q].cost);
    EXPECT_EQ(one[q].score, four[q].score);
  }
}

}  // namespace
