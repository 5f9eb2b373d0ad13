#include "support/random_images.hpp"

#include <gtest/gtest.h>

#include <place/describe/quantise.hpp>
#include <place/route/route.hpp>

namespace {

place::Route route_of_two_keyframes() {
  place::Route route;
  route.traverses.resize(2);
  for (place::Traverse& traverse : route.traverses) traverse.keyframes.resize(2);
  return route;
}

TEST(Route, KnowsWhetherThereArePoses) {
  place::Route route = route_of_two_keyframes();
  EXPECT_FALSE(place::has_poses({}));
  EXPECT_FALSE(place::has_poses(route));
  route.traverses[1].keyframes[1].pose = vo::Pose2{1, 2, 0};
  EXPECT_TRUE(place::has_poses(route));
}

TEST(Route, KnowsWhereATraverseWasInterrupted) {
  place::Traverse traverse;
  EXPECT_TRUE(place::gaps_of(traverse).empty());
  traverse.keyframes.resize(4);
  EXPECT_TRUE(place::gaps_of(traverse).empty());
  traverse.keyframes[1].after_gap = traverse.keyframes[3].after_gap = true;
  EXPECT_EQ(place::gaps_of(traverse), (std::vector<std::size_t>{1, 3}));
}

TEST(Route, KnowsHowFarATraverseWasSurveyed) {
  place::Traverse traverse;
  EXPECT_EQ(place::surveyed_m(traverse), std::nullopt);
  traverse.keyframes.resize(5);
  traverse.keyframes[1].distance_m = 2;
  EXPECT_EQ(place::surveyed_m(traverse), std::nullopt);
  traverse.keyframes[2].distance_m = 3;
  traverse.keyframes[3].distance_m = 7;
  EXPECT_EQ(place::surveyed_m(traverse), 5);
}

TEST(Route, FindsThumbnailsWhereverTheyAre) {
  place::Traverse traverse = route_of_two_keyframes().traverses.front();
  EXPECT_EQ(place::thumbnails_of(traverse), nullptr);
  traverse.descriptors = {place::make_column_stack(2, 5, 2), test_support::random_images(8, 4, 2, 1)};
  const vo::ImageStack* images = place::thumbnails_of(traverse);
  ASSERT_NE(images, nullptr);
  EXPECT_EQ(images->width, 8);
  traverse.thumbnails = test_support::random_images(16, 8, 2, 2);  // kept beside the descriptors
  EXPECT_EQ(place::thumbnails_of(traverse), &traverse.thumbnails);
}

}  // namespace
