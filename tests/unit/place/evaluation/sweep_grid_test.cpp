#include "place/evaluation/sweep_grid.hpp"

#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using place::SweepAxis;
using place::SweepCell;
using test_support::TemporaryFolder;

TEST(SweepGrid, ReadsAxes) {
  const SweepAxis axis = place::parse_axis("--enhance=local,,none");
  EXPECT_EQ(axis.setting, "enhance");
  EXPECT_EQ(axis.values, (std::vector<std::string>{"local", "none"}));
  for (const char* none : {"enhance", "=local", "enhance=", "--=x"})
    EXPECT_THROW_WITH(place::parse_axis(none), vo::Error, "NAME=a,b,c");
}

TEST(SweepGrid, HasEveryCellTheLastAxisFastest) {
  EXPECT_EQ(place::all_cells({{"a", {"1", "2"}}, {"b", {"x", "y"}}}),
            (std::vector<SweepCell>{{"1", "x"}, {"1", "y"}, {"2", "x"}, {"2", "y"}}));
  EXPECT_EQ(place::all_cells({}), std::vector<SweepCell>{{}});
}

TEST(SweepGrid, PutsACellsValuesIntoTheSettings) {
  place::Settings base;
  base.sampling_n = 3;
  const auto settings =
      place::settings_at(base, {{"motion", {"steps"}}, {"enhance", {"local"}}}, {"steps", "local"});
  EXPECT_EQ(settings.motion, "steps");
  EXPECT_EQ(settings.enhance, "local");
  EXPECT_EQ(settings.sampling_n, 3);
  const auto refused = [&](const char* name, const char* value, const char* said) {
    EXPECT_THROW_WITH(place::settings_at(base, {{name, {value}}}, {value}), vo::Error, said);
  };
  refused("preview-width-px", "32", "--vary preview-width-px: cannot vary");
  refused("motion-file", "walk.tum", "cannot vary");
  refused("motion", "file", "cannot be swept");
  refused("motion", "feet", "motion: is 'feet'");
  refused("enhanse", "local", "enhanse: is no setting; expected enhance?");
}

TEST(SweepGrid, KnowsWhatShapesTheMatrix) {
  EXPECT_TRUE(place::shapes_the_matrix("sampling-n"));
  EXPECT_TRUE(place::shapes_the_matrix("max-shift-px"));
  EXPECT_FALSE(place::shapes_the_matrix("sequence-length"));
}

TEST(SweepCsv, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const std::vector<SweepAxis> axes{{"motion", {"sad", "none"}}};
  place::SweepResults results;
  results[{"sad"}] = place::CellResult{.query_keyframes = 4, .reference_keyframes = 5, .max_f1 = 0.5};
  results.at({"sad"})->density = "sampling-n=6";
  results[{"none"}] = std::nullopt;
  const std::string csv = place::sweep_csv(axes, results);
  const auto again = place::read_sweep(folder.write("sweep.csv", csv), axes);
  EXPECT_EQ(place::sweep_csv(axes, again), csv);
  EXPECT_THROW_WITH(place::read_sweep(folder / "sweep.csv", {{"enhance", {"none"}}}), vo::Error,
                    "did not vary enhance");
}

TEST(ReadSweep, RefusesAFileOfMoreAxes) {
  const TemporaryFolder folder;
  const std::vector<place::SweepAxis> both{{"motion", {"sad"}}, {"enhance", {"none"}}};
  const auto file =
      folder.write("sweep.csv", place::sweep_csv(both, {{{"sad", "none"}, place::CellResult{}}}));
  EXPECT_THROW_WITH(place::read_sweep(file, {{"motion", {"sad"}}}), vo::Error,
                    "is of a sweep of other settings");
}

}  // namespace
