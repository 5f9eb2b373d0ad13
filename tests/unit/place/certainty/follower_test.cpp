#include "support/known_walk.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core/mat.hpp>

#include <place/certainty/follower.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace {

using namespace test_support;
using place::FollowState;

/// The wall's pictures as frames of a camera; what `make_thumbnail` makes of one is the picture itself.
vo::Frame frame_of(const KnownWalk& known, std::size_t i) {
  const auto pixels = known.walk.thumbnails[i];
  cv::Mat image(Wall::kHeight, Wall::kWidth, CV_8U);
  std::ranges::copy(pixels, image.data);
  return {
      .index = static_cast<std::int64_t>(i), .time_s = known.walk.time_s[i], .image = image, .colour = {}};
}

std::vector<place::Position> follow(const place::Route& route, const KnownWalk& known, std::size_t frames,
                                    const place::FollowerOptions& options = {}) {
  place::Follower follower(route, {}, options);
  std::vector<place::Position> all;
  for (std::size_t i = 0; i < std::min(frames, known.walk.frames()); ++i)
    all.push_back(follower.push(frame_of(known, i)));
  return all;
}

class FollowerTest : public testing::Test {
 protected:
  FollowerTest() {
    route_.settings.descriptor = "thumbnail";
    add_traverse(route_, "day", day_);
  }

  Wall wall_{kWallPx, 1};
  KnownWalk day_ = steady_walk(wall_, 0.5);
  KnownWalk night_ = steady_walk(wall_, 0.8, 100, 500);
  place::Route route_;
};

TEST_F(FollowerTest, FindsAWalkerAndKeepsToHim) {
  const auto positions = follow(route_, night_, 1000);
  std::size_t found = 0;
  while (found < positions.size() && positions[found].state != FollowState::kOnRoute) ++found;
  ASSERT_LT(found, 150U);  // 12 m of wall at a tenth of a metre a pixel
  for (std::size_t i = found; i < positions.size(); ++i) {
    ASSERT_EQ(positions[i].state, FollowState::kOnRoute) << i;
    const place::FollowedPlace& at = *positions[i].place;
    EXPECT_EQ(at.traverse, "day");
    EXPECT_NEAR(*at.distance_m, night_.place_px[i] / 10, 2 * spacing_px(route_.traverses[0]) / 10) << i;
    EXPECT_NEAR(at.pose->x_m, *at.distance_m, 1e-9);
    EXPECT_GT(*at.sd_m, 0);
  }
}

TEST_F(FollowerTest, DependsOnNoLaterFrame) {
  const auto all = follow(route_, night_, 400, {.lag_s = 1}),
             some = follow(route_, night_, 200, {.lag_s = 1});
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(all[i].state, some[i].state);
    EXPECT_EQ(all[i].off_route, some[i].off_route);
    EXPECT_EQ(all[i].lag_frame, some[i].lag_frame);
    ASSERT_EQ(all[i].place.has_value(), some[i].place.has_value());
    if (all[i].place) {
      EXPECT_EQ(all[i].place->distance_m, some[i].place->distance_m);
    }
  }
}

TEST_F(FollowerTest, IsTheSameForAnyNumberOfThreads) {
  vo::set_thread_count(1);
  const auto one = follow(route_, night_, 200);
  vo::set_thread_count(3);
  const auto three = follow(route_, night_, 200);
  vo::set_thread_count(0);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].off_route, three[i].off_route);
}

TEST_F(FollowerTest, LooksBackByItsLag) {
  const auto positions = follow(route_, night_, 450, {.lag_s = 1});
  const place::Position& last = positions.back();
  ASSERT_TRUE(last.lag_frame && last.lag_place);
  // The last description that is a second old; they are half a keyframe apart, far less than half a second.
  EXPECT_LE(*last.lag_frame, last.frame - 30);
  EXPECT_GE(*last.lag_frame, last.frame - 50);
  EXPECT_NEAR(*last.lag_place->distance_m, night_.place_px[static_cast<std::size_t>(*last.lag_frame)] / 10,
              2 * spacing_px(route_.traverses[0]) / 10);
}

TEST_F(FollowerTest, FinishesWithWhatTheLagHeldBack) {
  place::Follower follower(route_, {}, {.lag_s = 1}), without(route_);
  EXPECT_TRUE(follower.finish().empty());
  std::vector<std::int64_t> described;
  place::Position last;
  for (std::size_t i = 0; i < 400; ++i) {
    last = follower.push(frame_of(night_, i));
    if (last.described) described.push_back(last.frame);
    without.push(frame_of(night_, i));
  }
  EXPECT_TRUE(without.finish().empty());
  const std::vector<place::EarlierPlace> earlier = follower.finish();
  ASSERT_GT(earlier.size(), 1U);
  ASSERT_GT(described.size(), earlier.size());
  // Those from the last one that was answered on: the same answer of that one, a new one of each other.
  EXPECT_EQ(earlier.front().frame, *last.lag_frame);
  EXPECT_EQ(earlier.front().place->distance_m, last.lag_place->distance_m);
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    EXPECT_EQ(earlier[i].frame, described[described.size() - earlier.size() + i]);
    EXPECT_NEAR(*earlier[i].place->distance_m,
                night_.place_px[static_cast<std::size_t>(earlier[i].frame)] / 10,
                2 * spacing_px(route_.traverses[0]) / 10);
  }
}

TEST_F(FollowerTest, SaysWhenTheRouteIsLeft) {
  const Wall elsewhere(kWallPx, 99);
  KnownWalk walk = steady_walk(wall_, 0.8, 100, 400);
  const std::size_t leaves = walk.walk.frames();
  const KnownWalk away = steady_walk(elsewhere, 0.8, 0, 300);
  place::Follower follower(route_);
  place::Position last;
  for (std::size_t i = 0; i < leaves; ++i) last = follower.push(frame_of(walk, i));
  EXPECT_EQ(last.state, FollowState::kOnRoute);
  for (std::size_t i = 0; i < away.walk.frames(); ++i) {
    vo::Frame frame = frame_of(away, i);
    frame.index += static_cast<std::int64_t>(leaves);
    frame.time_s += walk.walk.time_s.back() + 1.0 / 30;
    last = follower.push(frame);
  }
  EXPECT_EQ(last.state, FollowState::kOffRoute);
  EXPECT_FALSE(last.place);
  EXPECT_GT(last.off_route, 0.5);
}

TEST_F(FollowerTest, GoesOnInTheDark) {
  place::Follower follower(route_);
  place::Position lit, dark;
  for (std::size_t i = 0; i < 400; ++i) {
    vo::Frame frame = frame_of(night_, i);
    if (i >= 360) frame.image.setTo(0);
    (i < 360 ? lit : dark) = follower.push(frame);
  }
  ASSERT_TRUE(lit.place && dark.place);
  // 40 frames of 0.08 m, at a speed ratio that is known to about a fifth.
  EXPECT_NEAR(*dark.place->distance_m - *lit.place->distance_m, 3.2, 1);
  EXPECT_GT(*dark.place->sd_m, *lit.place->sd_m);
}

TEST(Follower, RefusesRoutesThatCannotBeFollowed) {
  const place::Route empty;
  EXPECT_THROW(place::Follower{empty}, vo::Error);
}

TEST(Follower, NamesItsStates) {
  EXPECT_EQ(place::name_of(FollowState::kSearching), "searching");
  EXPECT_EQ(place::name_of(FollowState::kOnRoute), "on_route");
  EXPECT_EQ(place::name_of(FollowState::kOffRoute), "off_route");
}

}  // namespace
