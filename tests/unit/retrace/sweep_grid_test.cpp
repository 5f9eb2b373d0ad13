#include "sweep_grid.hpp"

#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using retrace::Axis;
using retrace::Cell;
using test_support::TemporaryFolder;

TEST(SweepGrid, ReadsAxes) {
  const Axis axis = retrace::parse_axis("--enhance=local,,none");
  EXPECT_EQ(axis.setting, "enhance");
  EXPECT_EQ(axis.values, (std::vector<std::string>{"local", "none"}));
  for (const char* none : {"enhance", "=local", "enhance=", "--=x"})
    EXPECT_THROW_WITH(retrace::parse_axis(none), vo::Error, "NAME=a,b,c");
}

TEST(SweepGrid, HasEveryCellTheLastAxisFastest) {
  EXPECT_EQ(retrace::all_cells({{"a", {"1", "2"}}, {"b", {"x", "y"}}}),
            (std::vector<Cell>{{"1", "x"}, {"1", "y"}, {"2", "x"}, {"2", "y"}}));
  EXPECT_EQ(retrace::all_cells({}), std::vector<Cell>{{}});
}

TEST(SweepGrid, PutsACellsValuesIntoTheSettings) {
  place::Settings base;
  base.sampling_n = 3;
  const auto settings =
      retrace::settings_at(base, {{"motion", {"steps"}}, {"enhance", {"local"}}}, {"steps", "local"});
  EXPECT_EQ(settings.motion, "steps");
  EXPECT_EQ(settings.enhance, "local");
  EXPECT_EQ(settings.sampling_n, 3);
  const auto refused = [&](const char* name, const char* value, const char* said) {
    EXPECT_THROW_WITH(retrace::settings_at(base, {{name, {value}}}, {value}), vo::Error, said);
  };
  refused("thumbnail-width", "32", "--vary thumbnail-width: cannot vary");
  refused("compat", "openseqslam", "cannot vary");
  refused("motion", "file", "cannot be swept");
  refused("motion", "feet", "motion: is 'feet'");
  refused("enhanse", "local", "enhanse: is no setting; expected enhance?");
}

TEST(SweepGrid, KnowsWhatShapesTheMatrix) {
  EXPECT_TRUE(retrace::shapes_the_matrix("sampling-n"));
  EXPECT_TRUE(retrace::shapes_the_matrix("max-shift-px"));
  EXPECT_FALSE(retrace::shapes_the_matrix("sequence-length"));
}

TEST(SweepCsv, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const std::vector<Axis> axes{{"motion", {"sad", "none"}}};
  retrace::SweepResults results;
  results[{"sad"}] = retrace::CellResult{.query_keyframes = 4, .reference_keyframes = 5, .max_f1 = 0.5};
  results[{"none"}] = std::nullopt;
  const std::string csv = retrace::sweep_csv(axes, results);
  const auto again = retrace::read_sweep(folder.write("sweep.csv", csv), axes);
  EXPECT_EQ(retrace::sweep_csv(axes, again), csv);
  EXPECT_THROW_WITH(retrace::read_sweep(folder / "sweep.csv", {{"enhance", {"none"}}}), vo::Error,
                    "did not vary enhance");
}

}  // namespace
