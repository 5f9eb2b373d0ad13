#include "support/random_images.hpp"

#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/streamed_search.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::Enhancement;
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
  // More queries than a block has, whether all of their costs are kept, some or none.
  const Walks walks(230, 400, 100);
  for (const Enhancement method : kMethods) {
    for (const int shift : {0, 1}) {
      place::StreamedSearchOptions options{.cost = {.max_shift_px = shift},
                                           .enhancement = {.method = method}};
      auto matrix = place::cost_matrix(walks.query, walks.reference, options.cost);
      const auto raw = matrix;
      place::enhance_contrast(matrix, options.enhancement);
      const auto expected = place::search_sequences(matrix, options.search);
      for (const std::size_t kept_rows : {0, 100, 1000}) {
        SCOPED_TRACE(testing::Message()
                     << static_cast<int>(method) << ", shift " << shift << ", kept " << kept_rows);
        options.kept_bytes = kept_rows * 400 * sizeof(float);
        std::size_t next = 0;
        const auto found =
            place::search_streamed(walks.query, walks.reference, options, [&](const place::MatrixRows& rows) {
              ASSERT_EQ(rows.first, next);
              for (std::size_t i = 0; i < rows.cost.size() / 400; ++i, ++next) {
                ASSERT_TRUE(std::ranges::equal(rows.cost.subspan(i * 400, 400), raw.row(next)));
                ASSERT_TRUE(std::ranges::equal(rows.enhanced.subspan(i * 400, 400), matrix.row(next)));
              }
            });
        EXPECT_EQ(next, 230U);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t q = 0; q < found.size(); ++q) {
          EXPECT_EQ(found[q].reference, expected[q].reference) << q;
          // The searcher rounds costs of up to 15 deviations in tens at 2^-22.
          EXPECT_NEAR(found[q].cost, expected[q].cost, 1e-6) << q;
          EXPECT_NEAR(found[q].score, expected[q].score, 2e-6) << q;
          EXPECT_EQ(found[q].terms, expected[q].terms) << q;
        }
        EXPECT_EQ(found[115].reference, 215U);  // and it is the right place
      }
    }
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
  EXPECT_THROW(place::search_streamed(images, images, {.cost = {.max_shift_px = 4}}), std::invalid_argument);
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
