#include "support/temporary_folder.hpp"

#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/trajectory_io.hpp>

namespace {

using test_support::TemporaryFolder;
using testing::ElementsAre;

constexpr double kDegree = std::numbers::pi / 180;

TEST(Truth, ReadsFramesInOrder) {
  const TemporaryFolder folder;
  const std::string header = "frame,time_s,x_m,y_m,heading_deg,distance_m,steps\n";
  const vo::WalkTruth truth =
      vo::read_truth(folder.write("t.csv", header + "0,0,1,2,90,0,0\n1,0.04,1.5,2,-270,0.5,1\n"));
  EXPECT_THAT(truth.distance_m, ElementsAre(0, 0.5));
  EXPECT_THAT(truth.steps, ElementsAre(0, 1));
  ASSERT_TRUE(truth.pose[1]);
  EXPECT_NEAR(truth.pose[1]->heading_rad, 90 * kDegree, 1e-12);
  EXPECT_DOUBLE_EQ(truth.pose[1]->x_m, 1.5);

  EXPECT_THROW_WITH(vo::read_truth(folder.write("t.csv", header)), vo::Error, "has no rows");
  EXPECT_THROW_WITH(vo::read_truth(folder.write("t.csv", header + "1,0,0,0,0,0,0\n")), vo::Error,
                    "line 2: frame is 1; expected 0");
  EXPECT_THROW_WITH(vo::read_truth(folder.write("t.csv", header + "0,1,0,0,0,0,0\n1,1,0,0,0,0,0\n")),
                    vo::Error, "line 3: time 1 s does not follow 1 s");
  EXPECT_THROW_WITH(vo::read_truth(folder.write("t.csv", "frame,time_s\n0,0\n")), vo::Error, "has no column");
  EXPECT_THROW_WITH(vo::read_truth(folder.write("t.csv", header + "0,0,0,0,0,2,0\n1,1,0,0,0,1.5,0\n")),
                    vo::Error, "line 3: distance 1.5 m is less than the 2 m before");
}

TEST(Truth, TimesAreInSeconds) {
  const TemporaryFolder folder;
  const auto truth = [&](double step, double speed_m, bool poses) {
    std::string text = "frame,time_s,x_m,y_m,heading_deg,distance_m\n";
    for (int i = 0; i < 50; ++i) {
      text += poses ? fmt::format("{},{},0,{},0,\n", i, step * i, speed_m * i)
                    : fmt::format("{},{},,,,{}\n", i, step * i, speed_m * i);
    }
    return folder.write("t.csv", text);
  };
  for (const bool poses : {false, true}) {
    // 25 frames a second at 1.25 m/s, by clocks that count faster.
    EXPECT_NO_THROW(vo::read_truth(truth(0.04, 0.05, poses)));
    EXPECT_THROW_WITH(
        vo::read_truth(truth(40, 0.05, poses)), vo::Error,
        "t.csv: has times in milliseconds, as it seems: 2 m from 0 to 1960; expected time_s in seconds");
    EXPECT_THROW_WITH(vo::read_truth(truth(4e7, 0.05, poses)), vo::Error, "in nanoseconds");
    // Pictures taken by hand, two minutes and 50 m apart.
    EXPECT_NO_THROW(vo::read_truth(truth(120, 50, poses)));
  }
}

TEST(Truth, EmptyCellsAreWhatIsNotKnown) {
  const TemporaryFolder folder;
  const vo::WalkTruth truth =
      vo::read_truth(folder.write("t.csv",
                                  "frame,time_s,x_m,y_m,heading_deg,distance_m,steps\n"
                                  "0,0,,,,,\n1,1,1,2,,3,1\n2,2,1,2,0,,\n"
                                  "3,3,1,3,0,4,\n4,4,,,,6,5\n5,5,,,,,\n"));
  using testing::Optional;
  const auto none = std::nullopt;
  EXPECT_THAT(truth.distance_m, ElementsAre(none, Optional(3), none, Optional(4), Optional(6), none));
  EXPECT_THAT(truth.steps, ElementsAre(none, Optional(1), none, none, Optional(5), none));
  EXPECT_EQ(vo::steps_in_all(truth), 5);
  EXPECT_EQ(vo::steps_in_all({}), none);
  // A pose without its heading is none.
  EXPECT_THAT(vo::poses_of(truth), testing::SizeIs(2));
  EXPECT_EQ(vo::poses_of(truth)[0].time_s, 2);
  const vo::PosesAlongRoute both = vo::poses_along_route(truth);
  EXPECT_THAT(both.poses, testing::SizeIs(1));
  EXPECT_THAT(both.distance_m, ElementsAre(4));
  EXPECT_THAT(vo::distances_between(truth), ElementsAre(3, 3, 3.5, 4, 6, 6));
  EXPECT_TRUE(vo::distances_between({}).empty());
  const vo::WalkTruth unknown = vo::read_truth(
      folder.write("t.csv", "frame,time_s,x_m,y_m,heading_deg,distance_m\n0,0,,,,\n1,1,,,,\n"));
  EXPECT_TRUE(vo::distances_between(unknown).empty());
}

TEST(Tum, RoundTripsPosesAndHeadings) {
  const TemporaryFolder folder;
  const vo::Trajectory walk{{0, {1, 2, 0}}, {0.5, {-3.25, 4, 100 * kDegree}}, {2, {0, 0, -170 * kDegree}}};
  const std::string text = vo::to_tum(walk, "a walk");
  EXPECT_EQ(text.substr(0, text.find('\n')), "# a walk");
  const vo::Trajectory back = vo::read_tum(folder.write("t.tum", text));
  ASSERT_EQ(back.size(), walk.size());
  for (std::size_t i = 0; i < walk.size(); ++i) {
    EXPECT_NEAR(back[i].time_s, walk[i].time_s, 1e-6);
    EXPECT_NEAR(back[i].pose.x_m, walk[i].pose.x_m, 1e-6);
    EXPECT_NEAR(back[i].pose.heading_rad, walk[i].pose.heading_rad, 1e-8);  // quaternions carry nine digits
  }
}

TEST(Tum, HeadingNorthIsYawOfAQuarterTurn) {
  // Heading 0 points along +y: a quarter turn from +x about z, half angle 45 degrees.
  EXPECT_EQ(vo::to_tum({{0, {0, 0, 0}}}), "0.000000 0.000000 0.000000 0 0 0 0.707106781 0.707106781\n");
  EXPECT_EQ(vo::to_tum({{0, {0, 0, 90 * kDegree}}}),
            "0.000000 0.000000 0.000000 0 0 0 0.000000000 1.000000000\n");
}

TEST(Tum, RefusesPosesWithoutTimes) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::read_tum(folder.write("kitti", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 2\n")),
                    vo::Error, "kitti: has poses without times; expected TUM's lines of 8 numbers");
}

}  // namespace
