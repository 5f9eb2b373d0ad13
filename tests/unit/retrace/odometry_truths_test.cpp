#include "odometry_truths.hpp"

#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using retrace::OdometryTruths;
using retrace::truth_of_each;

TEST(OdometryTruths, EachWalkHasItsOwn) {
  OdometryTruths truths;
  truths.paths = {"one.csv", "two.csv"};
  truths.map_scale_m_per_px = 0.25;
  truths.map_image = "map.png";
  auto each = truth_of_each(truths, 2);
  ASSERT_EQ(each.size(), 2U);
  EXPECT_EQ(each[0].path, "one.csv");
  EXPECT_EQ(each[1].path, "two.csv");
  EXPECT_EQ(each[1].map_scale_m_per_px, 0.25);
  EXPECT_EQ(each[1].map_image, "map.png");
  EXPECT_FALSE(each[1].steps);
  truths.true_steps = {40, 50};
  each = truth_of_each(truths, 2);
  EXPECT_EQ(each[0].steps, 40U);
  EXPECT_EQ(each[1].steps, 50U);
}

TEST(OdometryTruths, AreAsManyAsWalks) {
  OdometryTruths truths;
  EXPECT_THROW_WITH(truth_of_each(truths, 1), vo::Error, "--truth: names 0 files for 1 walks");
  truths.paths = {"one.csv", "two.csv"};
  EXPECT_THROW_WITH(truth_of_each(truths, 3), vo::Error, "--truth: names 2 files for 3 walks");
  truths.true_steps = {40};
  EXPECT_THROW_WITH(truth_of_each(truths, 2), vo::Error, "--true-steps: has 1 numbers for 2 walks");
}

TEST(OdometryTruths, KittisPosesAreOfOneWalk) {
  OdometryTruths truths;
  truths.kitti_poses = "03.txt";
  EXPECT_TRUE(truth_of_each(truths, 1).empty());
  EXPECT_THROW_WITH(truth_of_each(truths, 2), vo::Error, "--kitti-poses: is of one walk and 2 are given");
}

}  // namespace
