#include "support/known_walk.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/walk_sampling.hpp>
#include <vo/base/clock.hpp>
#include <vo/base/error.hpp>

namespace {

using namespace test_support;
using testing::IsEmpty;
using testing::SizeIs;

/// The walk with a trajectory file that has it 0.1 m on at each frame.
KnownWalk in_metres(KnownWalk known) {
  known.walk.track.emplace();
  known.walk.track->scale = vo::TrackScale::kMetric;
  for (std::size_t i = 0; i < known.walk.frames(); ++i)
    known.walk.track->frames.push_back({.valid = i > 0, .displacement = i > 0 ? 0.1 : 0, .sigma = 0});
  return known;
}

/// A route with one traverse along the wall at 1/2 pixel a frame, sampled by motion.
class WalkSamplingTest : public testing::Test {
 protected:
  WalkSamplingTest() { add_traverse(route_, "by day", steady_walk(wall_, 0.5)); }
  Wall wall_{kWallPx, 1};
  place::Route route_;
};

TEST(SampleWalk, EveryKthWithoutMotion) {
  const Wall wall(kWallPx, 1);
  const auto known = steady_walk(wall, 1, 0, 100);
  place::WalkSamplingOptions options;
  options.source = vo::MotionSource::kNone;
  options.every = 7;
  const auto sampled = place::sample_walk(known.walk, options);
  ASSERT_THAT(sampled.frames, SizeIs(15));  // 0, 7, ..., 98 of 101
  for (std::size_t k = 0; k < 15; ++k) EXPECT_EQ(sampled.frames[k], 7 * k);
  EXPECT_THAT(sampled.displacement, IsEmpty());
  EXPECT_FALSE(sampled.motion_model.learned());
  EXPECT_EQ(sampled.unit, 0);
  EXPECT_EQ(sampled.scale, 1);
  EXPECT_EQ(sampled.thumbnails.pixels, vo::select(known.walk.thumbnails, sampled.frames).pixels);
}

TEST_F(WalkSamplingTest, SamplesEvenlyWhateverTheSpeed) {
  // Half the frames go at twice the speed of the others.
  std::vector<double> speed_px(600, 0.3);
  speed_px.insert(speed_px.end(), 300, 0.6);
  const auto known = known_walk(wall_, places(50, speed_px));
  const auto sampled = sample_query(known, route_);
  std::vector<double> slow_px, fast_px;
  for (std::size_t k = 1; k < sampled.frames.size(); ++k) {
    const double gap_px = known.place_px[sampled.frames[k]] - known.place_px[sampled.frames[k - 1]];
    (sampled.frames[k] < 600 ? slow_px : fast_px).push_back(gap_px);
  }
  const auto median = [](std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
  };
  // Without motion the ratio would be 2; each gap is right to a step of a frame at either end.
  EXPECT_NEAR(median(fast_px) / median(slow_px), 1, 0.35);
  // Tied to the first traverse, keyframes lie as far apart as its do.
  EXPECT_NEAR(median(slow_px), spacing_px(route_.traverses[0]), 0.35 * spacing_px(route_.traverses[0]));
}

TEST(SampleWalk, TiesWalksInMetresByAPriorOfTheirOwn) {
  const Wall wall(kWallPx, 1);
  place::Route route;
  place::WalkSamplingOptions options;
  options.source = vo::MotionSource::kFile;
  add_traverse(route, "by day", in_metres(steady_walk(wall, 0.5)), options);
  ASSERT_TRUE(route.metric);
  // Metres that are wrong by 1.8.
  const auto query = in_metres(steady_walk(wall, 0.9));
  options.n = kSamplingN;
  const auto scale = [&] { return place::sample_walk(query.walk, options, &route).scale; };
  EXPECT_NEAR(scale(), 1.8, 0.2);  // as relative_scale: half a keyframe over half a sequence, 0.1 of 1.8
  options.relative_scale.prior_weight = 1e6;
  EXPECT_NEAR(scale(), 1.8, 0.2);
  options.metric_scale.prior_weight = 1e6;
  EXPECT_NEAR(scale(), 1, 0.1);
}

TEST_F(WalkSamplingTest, TiesTheScaleToTheFirstTraverse) {
  // Walks at one speed throughout are sampled by their own mean: at 0.9 pixels a frame instead of 0.5, a
  // keyframe step reaches 1.8 times as far.
  const auto fast = steady_walk(wall_, 0.9);
  place::WalkSamplingOptions options;
  options.n = kSamplingN;
  const auto tied = place::sample_walk(fast.walk, options, &route_);
  EXPECT_NEAR(tied.scale, 1.8, 0.2);  // as relative_scale: half a keyframe over half a sequence, 0.1 of 1.8
  options.tie_scale = false;
  const auto loose = place::sample_walk(fast.walk, options, &route_);
  EXPECT_EQ(loose.scale, 1);
  EXPECT_LT(loose.frames.size(), tied.frames.size());
  EXPECT_EQ(loose.unit, route_.unit);
}

TEST_F(WalkSamplingTest, TiesTheScaleToTheTraverseThatTheWalkFits) {
  place::Route route;
  add_traverse(route, "elsewhere", steady_walk(Wall(kWallPx, 2), 0.5));
  add_traverse(route, "by day", steady_walk(wall_, 0.5));
  place::WalkSamplingOptions options;
  options.n = kSamplingN;
  EXPECT_NEAR(place::sample_walk(steady_walk(wall_, 0.9).walk, options, &route).scale, 1.8, 0.2);
}

TEST_F(WalkSamplingTest, BeginsAnewAfterALongJumpOfTheClock) {
  const auto known = steady_walk(wall_, 0.5);
  const auto plain = sample_query(known, route_);
  // A frame that is no keyframe, half way between two.
  const std::size_t k = plain.frames.size() / 2;
  const std::size_t jump = (plain.frames[k] + plain.frames[k + 1]) / 2;
  ASSERT_GT(plain.frames[k + 1] - plain.frames[k], 2U);
  const auto after = [&](double jump_s) {
    auto jumped = known;
    for (std::size_t i = jump; i < jumped.walk.frames(); ++i) jumped.walk.time_s[i] += jump_s;
    jumped.walk.gaps = vo::clock_gaps(jumped.walk.time_s);
    return jumped;
  };
  const auto paused = sample_query(after(600), route_);
  EXPECT_TRUE(std::ranges::binary_search(paused.frames, jump));
  EXPECT_EQ(paused.displacement[jump], 0);
  const place::Traverse traverse = place::make_traverse("paused", after(600).walk, paused, std::nullopt);
  for (const place::Keyframe& keyframe : traverse.keyframes)
    EXPECT_EQ(keyframe.after_gap, keyframe.frame == static_cast<std::int64_t>(jump)) << keyframe.frame;
  const auto filled = sample_query(after(2), route_);  // the pace goes on
  EXPECT_GT(filled.displacement[jump], 0);
  EXPECT_THAT(place::gaps_of(place::make_traverse("filled", after(2).walk, filled, std::nullopt)), IsEmpty());
}

TEST_F(WalkSamplingTest, TheUnitOfAQueryIsInProportionToItsN) {
  const auto query = steady_walk(wall_, 0.5);
  place::WalkSamplingOptions options;
  options.tie_scale = false;
  options.n = kSamplingN / 2;
  EXPECT_EQ(place::sample_walk(query.walk, options, &route_).unit, route_.unit / 2);
  options.n.reset();
  EXPECT_THROW(place::sample_walk(query.walk, options, &route_), std::invalid_argument);
  options.spacing_m = 1;
  EXPECT_THROW_WITH(place::sample_walk(query.walk, options, &route_), vo::Error, "not in metres");
}

TEST(SampleWalk, KeyframesOfMetricMotionAreSoManyMetresApart) {
  const Wall wall(kWallPx, 1);
  const auto known = in_metres(steady_walk(wall, 0.5));  // 0.1 m a frame
  place::WalkSamplingOptions options;
  options.source = vo::MotionSource::kFile;
  options.spacing_m = 0.5;
  const auto sampled = place::sample_walk(known.walk, options);
  EXPECT_EQ(sampled.unit, 0.5);
  // Eq. 4 in metres: n times the mean displacement in 1/25 s; these frames are 1/30 s apart.
  options.spacing_m.reset();
  options.n = 3;
  EXPECT_NEAR(place::sample_walk(known.walk, options).unit, 3 * 0.1 * 30 / 25,
              1e-3);  // the first frame has none
}

TEST_F(WalkSamplingTest, MakesATraverseOfASampledWalk) {
  const auto known = steady_walk(wall_, 0.5);
  const place::Traverse& traverse = route_.traverses[0];
  EXPECT_EQ(traverse.name, "by day");
  EXPECT_EQ(traverse.source, "wall");
  EXPECT_EQ(traverse.pose_source, "truth.csv");
  EXPECT_EQ(traverse.frames, static_cast<std::int64_t>(known.place_px.size()));
  EXPECT_EQ(traverse.duration_s, known.walk.time_s.back());
  const vo::ImageStack* const thumbnails = place::thumbnails_of(traverse);
  ASSERT_TRUE(thumbnails);
  ASSERT_EQ(thumbnails->size(), traverse.keyframes.size());
  ASSERT_GT(traverse.keyframes.size(), 50U);
  for (std::size_t k = 0; k < traverse.keyframes.size(); ++k) {
    const auto& keyframe = traverse.keyframes[k];
    const auto frame = static_cast<std::size_t>(keyframe.frame);
    EXPECT_EQ(keyframe.time_s, known.walk.time_s[frame]);
    EXPECT_EQ(keyframe.distance_m, known.place_px[frame] / 10);
    EXPECT_EQ(keyframe.pose->x_m, known.place_px[frame] / 10);
    EXPECT_THAT((*thumbnails)[k], testing::ElementsAreArray(known.walk.thumbnails[frame]));
    // Each multiple of the unit has the frame nearest to it, which is within half the fastest step, 2.
    EXPECT_NEAR(keyframe.displacement, static_cast<double>(k) * route_.unit, 1) << k;
  }
}

TEST(MakeTraverse, RefusesTheSurveyOfAnotherWalk) {
  const Wall wall(100, 1);
  const auto known = steady_walk(wall, 1, 0, 20);
  place::WalkSamplingOptions options;
  options.source = vo::MotionSource::kNone;
  const auto sampled = place::sample_walk(known.walk, options);
  auto survey = survey_of(known);
  EXPECT_NO_THROW(place::make_traverse("a", known.walk, sampled, survey));
  survey.distance_m.pop_back();
  EXPECT_THROW(place::make_traverse("a", known.walk, sampled, survey), std::invalid_argument);
  const auto bare = place::make_traverse("a", known.walk, sampled, std::nullopt);
  EXPECT_EQ(bare.pose_source, "");
  EXPECT_FALSE(bare.keyframes[3].distance_m || bare.keyframes[3].pose);
  EXPECT_EQ(bare.keyframes[3].displacement, 0);
}

}  // namespace
