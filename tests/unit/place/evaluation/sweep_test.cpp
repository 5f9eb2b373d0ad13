#include "support/known_walk.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/evaluation/sweep.hpp>
#include <place/place.hpp>
#include <vo/base/error.hpp>

namespace {

using namespace test_support;
using place::SweepAxis;
using place::SweepResults;

class SweepTest : public testing::Test {
 protected:
  SweepTest() {
    input_.settings.descriptor = "thumbnail";  // all that these walks have
    input_.settings.search = "lines";
    input_.tolerance.tolerance_m = 1;
    input_.query = [this](const vo::WalkOptions& options) { return read(night_, options); };
    input_.reference = [this](const vo::WalkOptions& options) { return read(day_, options); };
    for (const double px : night_.place_px) input_.truth.query_distance_m.push_back(px / 10);
    for (const double px : day_.place_px) input_.truth.reference_distance_m.push_back(px / 10);
  }

  /// The wall has no points to follow.
  vo::Walk read(const KnownWalk& known, const vo::WalkOptions& options) {
    ++reads_;
    vo::Walk walk = known.walk;
    if (options.track_features) walk.tracked.resize(walk.frames());
    return walk;
  }

  Wall wall_{kWallPx, 1};
  KnownWalk day_ = steady_walk(wall_, 0.5);
  KnownWalk night_ = steady_walk(wall_, 0.8, 100, 500);
  place::SweepInput input_;
  int reads_ = 0;
};

TEST_F(SweepTest, RunsEveryCellAndReadsEachWalkOnce) {
  const std::vector<SweepAxis> axes{{"motion", {"sad", "none"}}, {"sequence-length", {"1", "10"}}};
  SweepResults results;
  EXPECT_TRUE(place::sweep(input_, axes, results));
  EXPECT_EQ(reads_, 2);
  EXPECT_THAT(results, testing::SizeIs(4));
  const auto resampled = results.at({"sad", "10"});
  ASSERT_TRUE(resampled);
  EXPECT_GT(resampled->max_f1, results.at({"sad", "1"})->max_f1 - 1e-9);
  EXPECT_EQ(resampled->query_keyframes, results.at({"sad", "1"})->query_keyframes);
}

TEST_F(SweepTest, KeepsAsManyKeyframesWithoutMotion) {
  const std::vector<SweepAxis> axes{{"motion", {"sad", "none"}}};
  SweepResults results;
  place::sweep(input_, axes, results);
  const auto count = [&](const char* motion) {
    const auto& cell = results.at({motion});
    return static_cast<double>(cell->query_keyframes + cell->reference_keyframes);
  };
  const double frames = static_cast<double>(day_.place_px.size() + night_.place_px.size());
  // Every K-th frame, K whole: within half a frame of what resampling keeps.
  const double every = frames / count("sad");
  EXPECT_GE(count("none"), frames / (every + 0.5) - 2);
  EXPECT_LE(count("none"), frames / (every - 0.5) + 2);
}

TEST_F(SweepTest, RunsThePublishedProgramBesideOurs) {
  input_.settings.motion = "none";
  input_.settings.every = 4;
  SweepResults results;
  place::sweep(input_, {{"compat", {"none", "openseqslam"}}, {"sequence-length", {"10"}}}, results);
  const auto ours = results.at({"none", "10"}), original = results.at({"openseqslam", "10"});
  ASSERT_TRUE(ours && original);
  EXPECT_EQ(ours->query_keyframes, original->query_keyframes);
  EXPECT_NE(ours->max_f1_threshold, original->max_f1_threshold);

  // The same as a run by itself.
  place::Settings settings = input_.settings;
  settings.search.reset();
  settings.sequence_length = 10;
  settings.compat = "openseqslam";
  place::Route route = place::new_route(settings);
  place::add(route, "reference", day_.walk, {}, settings);
  const auto alone =
      place::evaluate(place::localise(route, night_.walk, settings), input_.truth, {.tolerance_m = 1});
  constexpr double kNineDigits = 1e-9;  // as sweep.csv holds them
  EXPECT_NEAR(original->max_f1, alone.evaluation.best.f1, kNineDigits);
  EXPECT_NEAR(original->auc_pr, alone.evaluation.auc_pr, kNineDigits);
}

TEST_F(SweepTest, MakesDensitiesEqualIfAsked) {
  const std::vector<SweepAxis> axes{{"motion", {"sad", "none"}}, {"tie-scale", {"true", "false"}}};
  input_.equal_keyframes = true;
  input_.settings.sampling_n = 9;
  SweepResults results;
  place::sweep(input_, axes, results);
  const auto count = [&](const char* motion, const char* tie) {
    const auto& cell = results.at({motion, tie});
    return static_cast<double>(cell->query_keyframes + cell->reference_keyframes);
  };
  for (const char* const tie : {"true", "false"})
    EXPECT_NEAR(count("sad", tie), count("none", "true"), 0.05 * count("none", "true")) << tie;
  EXPECT_THAT(results.at({"none", "true"})->density, testing::StartsWith("every="));

  // The density that is said gives the same again.
  const std::string density = results.at({"sad", "true"})->density;
  ASSERT_THAT(density, testing::StartsWith("sampling-n="));
  input_.settings.sampling_n = std::stod(density.substr(density.find('=') + 1));
  input_.equal_keyframes = false;
  SweepResults again;
  place::sweep(input_, {{"motion", {"sad"}}}, again);
  EXPECT_EQ(again.at({"sad"})->query_keyframes, results.at({"sad", "true"})->query_keyframes);
  EXPECT_EQ(again.at({"sad"})->max_f1, results.at({"sad", "true"})->max_f1);
}

TEST_F(SweepTest, WithoutFixedSamplingTheFirstCellSetsTheDensity) {
  input_.equal_keyframes = true;
  SweepResults results, one;
  place::sweep(input_, {{"motion", {"sad"}}, {"separations", {"5", "1"}}}, results);
  input_.equal_keyframes = false;
  place::sweep(input_, {{"motion", {"sad"}}}, one);
  const auto total = [](const place::CellResult& r) {
    return static_cast<double>(r.query_keyframes + r.reference_keyframes);
  };
  EXPECT_EQ(total(*results.at({"sad", "5"})), total(*one.at({"sad"})));
  EXPECT_NEAR(total(*results.at({"sad", "1"})), total(*one.at({"sad"})), 0.05 * total(*one.at({"sad"})));
}

TEST_F(SweepTest, TakesSequencesInMetres) {
  const std::vector<SweepAxis> axes{{"motion", {"sad"}}, {"sequence-length-m", {"2", "8"}}};
  SweepResults metres, keyframes;
  place::sweep(input_, axes, metres);
  const double spacing_m =
      kWallPx / 10.0 / static_cast<double>(metres.at({"sad", "2"})->reference_keyframes - 1);
  const std::string eight = std::to_string(std::lround(8 / spacing_m));
  place::sweep(input_, {{"motion", {"sad"}}, {"sequence-length", {eight}}}, keyframes);
  EXPECT_EQ(metres.at({"sad", "8"})->max_f1_threshold, keyframes.at({"sad", eight})->max_f1_threshold);
  EXPECT_NE(metres.at({"sad", "8"})->max_f1_threshold, metres.at({"sad", "2"})->max_f1_threshold);
}

TEST_F(SweepTest, ReadsAWalkAgainForASettingOfReading) {
  SweepResults results;
  place::sweep(input_, {{"motion", {"sad"}}, {"tracking-window", {"3", "5"}}}, results);
  EXPECT_EQ(reads_, 4);
  EXPECT_THAT(results, testing::SizeIs(2));
}

TEST_F(SweepTest, GoesOnFromWhatIsThere) {
  const std::vector<SweepAxis> axes{{"motion", {"sad"}}, {"sequence-length", {"5", "10"}}};
  SweepResults results;
  results[{"sad", "5"}] = place::CellResult{.query_keyframes = 1234};
  place::sweep(input_, axes, results);
  EXPECT_EQ(results.at({"sad", "5"})->query_keyframes, 1234U);
  EXPECT_NE(results.at({"sad", "10"})->query_keyframes, 1234U);
  reads_ = 0;
  place::sweep(input_, axes, results);
  EXPECT_EQ(reads_, 0);
}

TEST_F(SweepTest, KeepsResultsAsItGoesAndStopsWhenAsked) {
  const std::vector<SweepAxis> axes{{"motion", {"sad"}}, {"enhance", {"local", "none"}}};
  SweepResults results, kept;
  EXPECT_FALSE(place::sweep(input_, axes, results,
                            {.keep = [&](const SweepResults& all) { kept = all; },
                             .progress = [](const vo::Progress&) { return false; }}));
  EXPECT_THAT(kept, testing::SizeIs(1));
  EXPECT_EQ(results.size(), kept.size());
}

TEST_F(SweepTest, WarnsOfCellsThatCannotBeRun) {
  const std::vector<SweepAxis> axes{{"motion", {"steps", "sad"}}};  // a wall without points has no steps
  SweepResults results;
  std::vector<std::string> warnings;
  EXPECT_TRUE(
      place::sweep(input_, axes, results, {.warn = [&](const std::string& w) { warnings.push_back(w); }}));
  EXPECT_FALSE(results.at({"steps"}));
  EXPECT_TRUE(results.at({"sad"}));
  ASSERT_THAT(warnings, testing::SizeIs(1));
  EXPECT_THAT(warnings.front(), testing::StartsWith("motion steps: "));
  const std::vector<SweepAxis> long_ones{{"motion", {"sad"}}, {"sequence-length", {"1000"}}};
  results.clear();
  place::sweep(input_, long_ones, results);
  EXPECT_FALSE(results.at({"sad", "1000"}));
}

TEST(CheckSweep, RefusesASettingWithoutEffect) {
  place::Settings base;
  base.step_length = 0.8;
  EXPECT_THROW_WITH(place::check_sweep(base, {{"motion", {"sad", "none"}}}), vo::Error,
                    "step-length: has no effect in any cell");
  EXPECT_NO_THROW(place::check_sweep(base, {{"motion", {"sad", "steps"}}}));
  EXPECT_THROW_WITH(place::check_sweep({}, {{"sequence-length", {"0"}}}), vo::Error, "sequence-length");
  EXPECT_THROW_WITH(place::check_sweep({}, {{"motion", {"sad", "none"}}, {"every", {"2"}}}, true), vo::Error,
                    "equal-keyframes: sets every, which is varied");
  EXPECT_THROW_WITH(place::check_sweep({}, {{"motion", {"sad"}}, {"enhance", {"local", "none"}}}, true),
                    vo::Error, "equal-keyframes: has no effect");
}

TEST_F(SweepTest, ThrowsWhatTheReadersThrow) {
  input_.query = [](const vo::WalkOptions&) -> vo::Walk {
    throw vo::Error("walk.mp4", "cannot be read", "a video");
  };
  SweepResults results;
  EXPECT_THROW(place::sweep(input_, {{"motion", {"sad"}}}, results), vo::Error);
  EXPECT_TRUE(results.empty());
}

TEST_F(SweepTest, WithoutEnhancementIsTheSameAsARunByItself) {
  input_.settings.motion = "none";
  input_.settings.every = 4;
  input_.settings.search = "path";
  input_.settings.enhance = "none";
  SweepResults results;
  place::sweep(input_, {{"sequence-length", {"10"}}}, results);
  place::Settings settings = input_.settings;
  settings.sequence_length = 10;
  place::Route route = place::new_route(settings);
  place::add(route, "reference", day_.walk, {}, settings);
  const auto alone =
      place::evaluate(place::localise(route, night_.walk, settings), input_.truth, {.tolerance_m = 1});
  EXPECT_NEAR(results.at({"10"})->max_f1_threshold, alone.evaluation.best.threshold, 1e-6);  // nine digits
}

TEST_F(SweepTest, ReadsWithTheCameraOfTheCellsThatFollowPoints) {
  input_.settings.fov_deg = 90;
  double fov_deg = 0;
  input_.query = [&](const vo::WalkOptions& options) {
    fov_deg = options.tracker.fov_deg;
    return read(night_, options);
  };
  SweepResults results;
  place::sweep(input_, {{"motion", {"sad", "steps"}}}, results);
  EXPECT_EQ(fov_deg, 90);
}

TEST_F(SweepTest, ThePublishedProgramFirstChangesNothingOfOurs) {
  input_.settings.motion = "none";
  input_.settings.every = 4;
  input_.settings.enhance = "local";
  SweepResults both, ours;
  place::sweep(input_, {{"compat", {"openseqslam", "none"}}}, both);
  place::sweep(input_, {{"compat", {"none"}}}, ours);
  EXPECT_EQ(both.at({"none"})->max_f1_threshold, ours.at({"none"})->max_f1_threshold);
}

}  // namespace
