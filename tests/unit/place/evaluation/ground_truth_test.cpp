#include "support/temporary_folder.hpp"

#include <optional>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/evaluation/ground_truth.hpp>
#include <vo/base/error.hpp>

namespace {

using place::ErrorUnit;
using test_support::TemporaryFolder;
using testing::ElementsAre;

/// The error of a match that has one.
double error_of(const place::GroundTruth& truth, std::int64_t query, std::int64_t reference, ErrorUnit unit,
                double tolerance = 4) {
  const auto error = place::place_error(truth, query, reference, unit, tolerance);
  EXPECT_TRUE(error.has_truth);
  return error.error.value_or(-1);
}

TEST(ReadPairs, ReadsLandmarks) {
  const TemporaryFolder folder;
  const auto pairs =
      place::read_pairs(folder.write("p.csv", "query_frame,reference_frame\n0,10\n20,50\n30.5,40\n"));
  EXPECT_THAT(pairs.query_frame, ElementsAre(0, 20, 30.5));
  EXPECT_THAT(pairs.reference_frame, ElementsAre(10, 50, 40));  // the walker may turn back
}

TEST(ReadPairs, NamesTheLineThatIsWrong) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& rows) {
    return place::read_pairs(folder.write("p.csv", "query_frame,reference_frame\n" + rows));
  };
  EXPECT_THROW_WITH(read(""), vo::Error, "p.csv");
  EXPECT_THROW_WITH(read("1,2\n"), vo::Error, "p.csv: has 1 rows; expected 2 landmarks");
  EXPECT_THROW_WITH(read("1,2\n1,3\n"), vo::Error, "line 3: query_frame 1 does not follow 1");
  EXPECT_THROW_WITH(read("1,2\n3,-3\n"), vo::Error, "line 3: has a negative frame");
  EXPECT_THROW_WITH(read("1,2\n3,1e300\n"), vo::Error, "line 3: has a frame that no video has");
  EXPECT_THROW_WITH(read("1,2\n3,x\n"), vo::Error, "line 3: reference_frame is 'x'");
  EXPECT_THROW_WITH(place::read_pairs(folder.write("p.csv", "query,reference\n1,2\n3,4\n")), vo::Error,
                    "has no column 'query_frame'");
  EXPECT_THROW_WITH(place::read_pairs(folder / "none.csv"), vo::Error, "none.csv: does not exist");
}

TEST(TrueReferenceFrame, IsInterpolatedBetweenLandmarksAndOnlyThere) {
  const place::LandmarkPairs pairs{.query_frame = {10, 20, 40}, .reference_frame = {100, 140, 120}};
  EXPECT_EQ(place::true_reference_frame(pairs, 10), 100);
  EXPECT_EQ(place::true_reference_frame(pairs, 15), 120);
  EXPECT_EQ(place::true_reference_frame(pairs, 20), 140);
  EXPECT_EQ(place::true_reference_frame(pairs, 25), 135);  // a quarter of the way back
  EXPECT_EQ(place::true_reference_frame(pairs, 40), 120);
  EXPECT_EQ(place::true_reference_frame(pairs, 9.99), std::nullopt);
  EXPECT_EQ(place::true_reference_frame(pairs, 40.01), std::nullopt);
  EXPECT_EQ(place::true_reference_frame({}, 1), std::nullopt);
}

TEST(PlaceError, OfLandmarksInFrames) {
  const place::GroundTruth truth{
      .pairs = place::LandmarkPairs{.query_frame = {10, 20}, .reference_frame = {100, 145}},
      .query_distance_m = {},
      .reference_distance_m = {}};
  EXPECT_EQ(error_of(truth, 10, 103, ErrorUnit::kFrames), 3);
  EXPECT_EQ(error_of(truth, 11, 100, ErrorUnit::kFrames), 4.5);
  const auto outside = place::place_error(truth, 9, 100, ErrorUnit::kFrames, 4);
  EXPECT_FALSE(outside.has_truth);
  EXPECT_FALSE(outside.error);
  const auto unmatched = place::place_error(truth, 15, std::nullopt, ErrorUnit::kFrames, 4);
  EXPECT_TRUE(unmatched.has_truth);
  EXPECT_FALSE(unmatched.error);
  EXPECT_THROW(place::place_error(truth, 15, 100, ErrorUnit::kMetres, 4), std::invalid_argument);
}

TEST(PlaceError, OfLandmarksInMetres) {
  // 0, 1, 3, 6, 10 m at reference frames 0 .. 4.
  const place::GroundTruth truth{
      .pairs = place::LandmarkPairs{.query_frame = {0, 10}, .reference_frame = {0, 4}},
      .query_distance_m = {},
      .reference_distance_m = {0, 1, 3, 6, 10}};
  // Query 5 is truly at frame 2, 3 m.
  EXPECT_DOUBLE_EQ(error_of(truth, 5, 4, ErrorUnit::kMetres), 7);
  // Query 4 is truly at frame 1.6: 1 + 0.6 * 2 m.
  EXPECT_DOUBLE_EQ(error_of(truth, 4, 2, ErrorUnit::kMetres), 0.8);
  EXPECT_DOUBLE_EQ(error_of(truth, 10, 4, ErrorUnit::kMetres), 0);  // the last frame has none after it
  EXPECT_THROW_WITH(place::place_error(truth, 5, 5, ErrorUnit::kMetres, 4), vo::Error,
                    "reference truth: has no frame 5; expected frames 0..4");
}

TEST(PlaceError, OfDistancesInMetres) {
  const place::GroundTruth truth{
      .pairs = std::nullopt, .query_distance_m = {0, 2, 5, 16}, .reference_distance_m = {1, 2, 4, 8, 10}};
  EXPECT_EQ(error_of(truth, 1, 3, ErrorUnit::kMetres), 6);
  // The query's 0 m and 16 m are 1 m and 6 m from what the reference reaches.
  EXPECT_EQ(error_of(truth, 0, 0, ErrorUnit::kMetres, 1), 1);
  EXPECT_FALSE(place::place_error(truth, 0, 0, ErrorUnit::kMetres, 0.99).has_truth);
  EXPECT_FALSE(place::place_error(truth, 3, 4, ErrorUnit::kMetres, 5.99).has_truth);
  EXPECT_TRUE(place::place_error(truth, 3, 4, ErrorUnit::kMetres, 6).has_truth);
  const auto unmatched = place::place_error(truth, 2, std::nullopt, ErrorUnit::kMetres, 4);
  EXPECT_TRUE(unmatched.has_truth);
  EXPECT_FALSE(unmatched.error);
}

TEST(PlaceError, OfDistancesInFrames) {
  const place::GroundTruth truth{.pairs = std::nullopt,
                                 .query_distance_m = {1, 5, 10, 0.5, 11},
                                 .reference_distance_m = {1, 2, 4, 8, 10}};
  EXPECT_EQ(error_of(truth, 0, 3, ErrorUnit::kFrames), 3);
  // 5 m lies a quarter of the way from frame 2 to frame 3.
  EXPECT_DOUBLE_EQ(error_of(truth, 1, 2, ErrorUnit::kFrames), 0.25);
  EXPECT_DOUBLE_EQ(error_of(truth, 1, 3, ErrorUnit::kFrames), 0.75);
  EXPECT_EQ(error_of(truth, 2, 4, ErrorUnit::kFrames), 0);
  // A tolerance in frames says nothing about metres beyond the reference's ends.
  EXPECT_FALSE(place::place_error(truth, 3, 0, ErrorUnit::kFrames, 2).has_truth);
  EXPECT_FALSE(place::place_error(truth, 4, 4, ErrorUnit::kFrames, 2).has_truth);
}

TEST(PlaceError, AnyFrameOfAStandingWalkerIsRight) {
  // The reference stands at 3 m from frame 2 to frame 5.
  const place::GroundTruth truth{
      .pairs = std::nullopt, .query_distance_m = {3}, .reference_distance_m = {0, 1, 3, 3, 3, 3, 4}};
  for (std::int64_t frame = 2; frame <= 5; ++frame)
    EXPECT_EQ(error_of(truth, 0, frame, ErrorUnit::kFrames), 0) << frame;
  EXPECT_EQ(error_of(truth, 0, 0, ErrorUnit::kFrames), 2);
  EXPECT_EQ(error_of(truth, 0, 6, ErrorUnit::kFrames), 1);
}

TEST(PlaceError, IsNoneWhereTheQuerysDistanceIsNotKnown) {
  const place::GroundTruth truth{
      .pairs = std::nullopt, .query_distance_m = {0, std::nullopt, 2}, .reference_distance_m = {0, 1, 2}};
  EXPECT_FALSE(place::place_error(truth, 1, 1, ErrorUnit::kMetres, 4).has_truth);
  EXPECT_FALSE(place::place_error(truth, 1, {}, ErrorUnit::kFrames, 4).has_truth);
  EXPECT_EQ(error_of(truth, 2, 1, ErrorUnit::kMetres), 1);
}

TEST(PlaceError, SaysWhichTruthDoesNotHaveTheFrame) {
  const place::GroundTruth truth{
      .pairs = std::nullopt, .query_distance_m = {0, 1}, .reference_distance_m = {0, 1, 2}};
  EXPECT_THROW_WITH(place::place_error(truth, 2, 0, ErrorUnit::kMetres, 4), vo::Error,
                    "query truth: has no frame 2; expected frames 0..1");
  EXPECT_THROW_WITH(place::place_error(truth, -1, 0, ErrorUnit::kMetres, 4), vo::Error,
                    "query truth: has no frame -1");
  EXPECT_THROW_WITH(place::place_error(truth, 1, 3, ErrorUnit::kFrames, 4), vo::Error,
                    "reference truth: has no frame 3");
  const place::GroundTruth one_sided{
      .pairs = std::nullopt, .query_distance_m = {0, 1}, .reference_distance_m = {}};
  EXPECT_THROW(place::place_error(one_sided, 0, 0, ErrorUnit::kMetres, 4), std::invalid_argument);
}

TEST(TrueReferenceFrame, IsExactWhereBothWalksGoAtOnePace) {
  const place::LandmarkPairs pairs{.query_frame = {0, 110}, .reference_frame = {3, 113}};
  for (int frame = 0; frame <= 110; ++frame) EXPECT_EQ(place::true_reference_frame(pairs, frame), frame + 3);
}

}  // namespace
