#include "place/evaluation/sweep_methods.hpp"

#include "support/known_walk.hpp"
#include "support/temporary_folder.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using namespace test_support;
using place::ComparedMethod;
using place::SweepAxis;
using place::SweepCell;
using place::SweepResults;

class CompareMethods : public testing::Test {
 protected:
  CompareMethods() {
    input_.settings.descriptor = "thumbnail";
    input_.settings.search = "lines";
    input_.tolerance.tolerance_m = 0.2;
    input_.query = [this](const vo::WalkOptions&) { return ++reads_, night_.walk; };
    input_.reference = [this](const vo::WalkOptions&) { return ++reads_, day_.walk; };
    for (const double px : night_.place_px) input_.truth.query_distance_m.push_back(px / 10);
    for (const double px : day_.place_px) input_.truth.reference_distance_m.push_back(px / 10);
  }

  Wall wall_{kWallPx, 1};
  KnownWalk day_ = steady_walk(wall_, 0.5);
  KnownWalk night_ = steady_walk(wall_, 0.8, 100, 500);
  place::SweepInput input_;
  int reads_ = 0;
  const std::vector<SweepAxis> axes_{
      {"motion", {"none", "sad"}}, {"sequence-length", {"5", "10"}}, {"search-range-rad", {"0.1", "0.6"}}};
};

TEST(StandardCell, HasTheDefaultsOrElseTheFirstValues) {
  const std::vector<SweepAxis> axes{
      {"motion", {"none", "steps"}}, {"sequence-length", {"5", "10"}}, {"search-range-rad", {"0.4", "0.6"}}};
  EXPECT_EQ(place::standard_cell(axes, {"motion"}, {"steps", "5", "0.6"}), (SweepCell{"steps", "10", "0.4"}));
  EXPECT_EQ(place::standard_cell(axes, {}, {"steps", "5", "0.6"}), (SweepCell{"none", "10", "0.4"}));
}

TEST_F(CompareMethods, TakesTheBestCellOfEach) {
  SweepResults results;
  place::sweep(input_, axes_, results);
  const int reads = reads_;
  const std::vector<ComparedMethod> methods = place::compare_methods(input_, axes_, {"motion"}, results);
  EXPECT_EQ(reads_, reads);  // every query is known already
  ASSERT_THAT(methods, testing::SizeIs(2));
  EXPECT_EQ(methods[0].values, SweepCell{"none"});
  EXPECT_EQ(methods[1].standard.cell, (SweepCell{"sad", "10", "0.1"}));
  for (const ComparedMethod& method : methods) {
    for (const auto& [cell, result] : results) {
      if (cell[0] == method.values[0]) {
        EXPECT_LE(result->max_f1, method.best.result.max_f1);
      }
    }
    EXPECT_EQ(method.standard.result.max_f1, results.at(method.standard.cell)->max_f1);
    EXPECT_EQ(method.with_truth, method.best.result.query_keyframes);
    ASSERT_TRUE(method.best.interval && method.standard.interval);
    EXPECT_LE(method.best.interval->low, method.best.interval->high);
  }
  EXPECT_EQ(methods[0].difference.interval->low, 0);  // from itself
  EXPECT_EQ(methods[0].difference.interval->high, 0);
}

TEST_F(CompareMethods, ComparesLikeWithLike) {
  const std::vector<SweepAxis> axes{{"motion", {"none", "sad"}}, {"enhance", {"local", "standardise"}}};
  SweepResults results;
  place::sweep(input_, axes, results);
  const auto methods = place::compare_methods(input_, axes, {"motion", "enhance"}, results);
  ASSERT_THAT(methods, testing::SizeIs(4));
  EXPECT_EQ(methods[3].values, (SweepCell{"sad", "standardise"}));
  EXPECT_EQ(methods[1].baseline, 1U);  // fixed sampling is the baseline
  EXPECT_EQ(methods[2].baseline, 0U);  // of the same enhancement
  EXPECT_EQ(methods[3].baseline, 1U);
  EXPECT_THROW(place::compare_methods(input_, axes, {}, results), vo::Error);
}

TEST_F(CompareMethods, RunsAgainWhatWasReadFromAFile) {
  SweepResults results;
  place::sweep(input_, axes_, results);
  const auto known = place::compare_methods(input_, axes_, {"motion"}, results);
  for (auto& [cell, result] : results) result->queries = {};
  const auto again = place::compare_methods(input_, axes_, {"motion"}, results);
  ASSERT_EQ(known.size(), again.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_EQ(known[i].best.interval->low, again[i].best.interval->low);
    EXPECT_EQ(known[i].difference.interval->high, again[i].difference.interval->high);
  }
}

TEST_F(CompareMethods, LeavesOutWhatCouldNotBeRunAndRefusesUnknownNames) {
  SweepResults results;
  for (const SweepCell& cell : place::all_cells(axes_)) results[cell] = std::nullopt;
  EXPECT_TRUE(place::compare_methods(input_, axes_, {"motion"}, results).empty());
  EXPECT_THROW_WITH(place::compare_methods(input_, axes_, {"enhance"}, results), vo::Error,
                    "--compare enhance: is not varied by this sweep");
}

TEST_F(CompareMethods, SaysWhichHaveNoDefaultToCompare) {
  const std::vector<SweepAxis> axes{{"motion", {"sad"}}, {"sequence-length", {"1000", "20"}}};
  SweepResults results;
  place::sweep(input_, axes, results);
  ASSERT_FALSE(results.at({"sad", "1000"}));  // longer than the walks
  ASSERT_TRUE(results.at({"sad", "20"}));
  std::vector<std::string> warned;
  const auto methods = place::compare_methods(
      input_, axes, {"motion"}, results, {.warn = [&](const std::string& text) { warned.push_back(text); }});
  EXPECT_TRUE(methods.empty());
  EXPECT_THAT(warned,
              testing::ElementsAre("sad is not compared: its default cell sad 1000 could not be run"));
}

}  // namespace
