#include "support/known_walk.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/place.hpp>
#include <vo/base/error.hpp>

namespace {

using namespace test_support;
using place::Settings;

/// The walks below are thumbnails and nothing else.
Settings by_thumbnails() {
  Settings settings;
  settings.descriptor = "thumbnail";
  return settings;
}

class PlaceTest : public testing::Test {
 protected:
  Wall wall_{kWallPx, 1};
  KnownWalk day_ = steady_walk(wall_, 0.5);
  KnownWalk night_ = steady_walk(wall_, 0.8, 100, 500);
};

TEST_F(PlaceTest, FindsAWalkOnARoute) {
  place::Route route = place::new_route(by_thumbnails());
  const auto added = place::add(route, "day", day_.walk, survey_of(day_));
  EXPECT_EQ(added.index, 0U);
  EXPECT_GT(route.unit, 0);
  Settings settings;
  settings.search_range_rad = 0.3;
  settings.correct_drift = false;  // these walks have no steps
  const place::Run run = place::localise(route, night_.walk, settings);
  EXPECT_EQ(run.matches.size(), run.sampled.frames.size());
  EXPECT_EQ(run.sequence_length, 10);
  EXPECT_EQ(run.settings.search_range_rad, 0.3);
  EXPECT_FALSE(run.trajectory);
  EXPECT_EQ(run.drift.why_not, "correct-drift is false");
  place::GroundTruth truth;
  for (const double px : night_.place_px) truth.query_distance_m.push_back(px / 10);
  for (const double px : day_.place_px) truth.reference_distance_m.push_back(px / 10);
  // Lines of whole keyframes stray by one or two of them at the ends of a walk.
  const double tolerance_m = 2 * spacing_px(route.traverses[0]) / 10;
  EXPECT_EQ(
      place::evaluate(run, truth, {.tolerance_m = tolerance_m, .tolerance_frames = {}}).evaluation.best.f1,
      1);
}

TEST_F(PlaceTest, IsTheSameOnARouteReadBack) {
  const TemporaryFolder folder;
  Settings settings;
  settings.sequence_length = 6;  // of the search: the route keeps it for the walks to come
  settings.sampling_n = 4;
  place::Route route = place::new_route(merged(settings, by_thumbnails()));
  place::add(route, "day", day_.walk);
  place::write_route(folder / "r.db", route);
  const place::Run one = place::localise(route, night_.walk);
  const place::Run two = place::localise(place::read_route(folder / "r.db"), night_.walk);
  EXPECT_EQ(one.settings, two.settings);
  EXPECT_EQ(two.sequence_length, 6);
  ASSERT_EQ(one.matches.size(), two.matches.size());
  for (std::size_t q = 0; q < one.matches.size(); ++q) EXPECT_EQ(one.matches[q].score, two.matches[q].score);
}

TEST_F(PlaceTest, SaysHowARouteIsBuiltThatCanBeLookedAtAgain) {
  place::Route route = place::new_route(by_thumbnails());
  place::add(route, "day", day_.walk);
  Settings settings;
  settings.verify = 5;
  const auto said = [&](const auto& act) {
    try {
      act();
    } catch (const vo::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string expected =
      "verify: is 5 and the route keeps no points of its keyframes; expected 0, or a route built with "
      "`retrace build --view-points true`";
  EXPECT_EQ(said([&] { place::localise(route, night_.walk, settings); }), expected);
  EXPECT_EQ(said([&] { place::read("none.mp4", route, settings); }), expected);  // before anything is read
}

TEST_F(PlaceTest, ARouteIsTheSameForAnyNumberOfThreads) {
  Settings settings;
  std::vector<Settings> kept;
  for (const int threads : {1, 2}) {
    settings.threads = threads;
    place::Route route = place::new_route(merged(settings, by_thumbnails()));
    place::add(route, "day", day_.walk, {}, settings);
    kept.push_back(route.traverses[0].settings);
    EXPECT_FALSE(route.settings.threads);
  }
  EXPECT_EQ(kept[0], kept[1]);
}

TEST_F(PlaceTest, ARunsSettingsRepeatIt) {
  place::Route route = place::new_route(by_thumbnails());
  place::add(route, "day", day_.walk);
  Settings settings;
  settings.sequence_length = 7;
  const place::Run once = place::localise(route, night_.walk, settings);
  const place::Run again = place::localise(route, night_.walk, once.settings);
  EXPECT_EQ(once.settings, again.settings);
  ASSERT_EQ(once.matches.size(), again.matches.size());
  for (std::size_t q = 0; q < once.matches.size(); ++q)
    EXPECT_EQ(once.matches[q].score, again.matches[q].score);
}

TEST_F(PlaceTest, AQueryIsSampledInTheRoutesUnit) {
  Settings settings;
  settings.sampling_n = 3;
  place::Route route = place::new_route(merged(settings, by_thumbnails()));
  place::add(route, "day", day_.walk);
  EXPECT_EQ(place::localise(route, night_.walk).sampled.unit, route.unit);
}

TEST_F(PlaceTest, ATraverseIsReplacedOnlyIfAsked) {
  place::Route route = place::new_route(by_thumbnails());
  place::add(route, "day", day_.walk);
  EXPECT_THROW_WITH(place::add(route, "day", day_.walk), vo::Error,
                    "day: is a traverse of the route already");
  const double unit = route.unit;
  EXPECT_EQ(place::add(route, "day", night_.walk, {}, {}, true).index, 0U);
  EXPECT_EQ(route.traverses.size(), 1U);
  EXPECT_EQ(route.unit, unit);
  EXPECT_EQ(place::add(route, "evening", day_.walk).index, 1U);
}

TEST_F(PlaceTest, AnAutomaticMotionIsSettledByTheFirstWalk) {
  Settings settings;
  settings.motion = "auto";
  place::Route route = place::new_route(merged(settings, by_thumbnails()));
  EXPECT_EQ(route.settings.motion, "auto");
  EXPECT_THROW(place::add(route, "day", day_.walk), std::invalid_argument);  // no points were tracked
  EXPECT_EQ(route.settings.motion, "auto");
  vo::Walk day = day_.walk;
  day.tracked.resize(day.frames());  // a wall without points to track
  EXPECT_EQ(place::add(route, "day", day).gait_share, 0);
  EXPECT_EQ(route.settings, place::new_route(merged(by_thumbnails(), route.settings)).settings);
  EXPECT_EQ(route.settings.motion, "sad");
  EXPECT_FALSE(place::add(route, "evening", night_.walk).gait_share);
  EXPECT_EQ(place::localise(route, night_.walk, settings).settings.motion, "sad");
}

TEST_F(PlaceTest, RefusesWalksThatWereReadWithOtherSettings) {
  Settings settings;
  settings.thumbnail_width = 32;
  place::Route route = place::new_route(merged(settings, by_thumbnails()));
  EXPECT_THROW(place::add(route, "day", day_.walk), std::invalid_argument);
  settings = {};
  settings.motion = "steps";
  route = place::new_route(merged(settings, by_thumbnails()));
  EXPECT_THROW(place::add(route, "day", day_.walk), std::invalid_argument);  // no points were tracked
}

TEST_F(PlaceTest, RefusesARouteWithoutTraversesAndAWalkOfOneKeyframe) {
  place::Route route = place::new_route(by_thumbnails());
  EXPECT_THROW(place::localise(route, night_.walk), std::invalid_argument);
  Settings settings;
  settings.motion = "none";
  settings.every = 100000;
  route = place::new_route(merged(settings, by_thumbnails()));
  EXPECT_THROW_WITH(place::add(route, "day", day_.walk), vo::Error, "gives a single keyframe");
}

}  // namespace
