#include "support/rendered_room.hpp"
#include "support/replaced.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/pose_series_io.hpp>

namespace {

using test_support::replaced;
using test_support::TemporaryFolder;
using test_support::turned;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Four poses a fifth of a second apart, north at a metre a second and a half, as TUM's lines.
constexpr std::string_view kNorth =
    "0.0 0 0.0 0 0 0 0.70710678 0.70710678\n"
    "0.2 0 0.3 0 0 0 0.70710678 0.70710678\n"
    "0.4 0 0.6 0 0 0 0.70710678 0.70710678\n"
    "0.6 0 0.9 0 0 0 0.70710678 0.70710678\n";

/// What is the same of all files that hold `kNorth`.
void expect_north(const vo::PoseSeries& series, std::string_view what) {
  EXPECT_THAT(series.time_s, ElementsAre(0, 0.2, 0.4, 0.6)) << what;
  ASSERT_EQ(series.poses.size(), 4U) << what;
  EXPECT_EQ(series.poses[3].position, cv::Vec3d(0, 0.9, 0)) << what;
  EXPECT_LT(cv::norm(series.poses[3].rotation * cv::Vec3d(1, 0, 0) - cv::Vec3d(0, 1, 0)), 1e-7) << what;
}

TEST(PoseSeries, RoundTripsThroughTum) {
  const TemporaryFolder folder;
  const std::vector<std::optional<vo::Pose3>> poses{turned(0.3, {1, 2, 3}), std::nullopt,
                                                    turned(-2, {-4, 5, 6})};
  const std::string text = vo::to_tum(poses, {0, 1, 2.5}, "poses");
  EXPECT_EQ(text.substr(0, text.find('\n')), "# poses");
  const vo::PoseSeries series =
      vo::read_pose_series(folder.write("t.tum", text), {.axes = vo::TrajectoryAxes::kCamera});
  EXPECT_THAT(series.time_s, ElementsAre(0, 2.5));
  EXPECT_EQ(series.axes, vo::BodyAxes::kCamera);
  EXPECT_THAT(series.warnings, IsEmpty());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(cv::norm(series.poses[i].position - poses[2 * i]->position), 1e-8);  // nine decimals
    EXPECT_LT(cv::norm(series.poses[i].rotation - poses[2 * i]->rotation), 1e-7);
  }
  EXPECT_THROW(vo::to_tum(poses, {0}, ""), std::invalid_argument);
}

TEST(PoseSeries, ReadsTumAsProgramsWriteIt) {
  const TemporaryFolder folder;
  const std::string north(kNorth);
  const auto reads = [&](const std::string& text) {
    const auto series = vo::read_pose_series(folder.write("t.tum", text));
    expect_north(series, text);
    EXPECT_THAT(series.warnings, IsEmpty()) << text;
  };
  reads(north);
  reads("# ground truth\n# timestamp tx ty tz qx qy qz qw\n" + north);
  reads("timestamp tx ty tz qx qy qz qw\n" + north);
  reads("\xEF\xBB\xBF" + north);
  reads(replaced(north, " ", ","));
  reads("timestamp,tx,ty,tz,qx,qy,qz,qw\n" + replaced(north, " ", ","));
  reads(replaced(north, " ", "\t"));
  for (const std::string quote : {"'", "\""}) {
    const std::string inner = quote + "," + quote;
    const std::string lines = replaced(replaced(north, " ", inner), "\n", quote + "\n" + quote);
    const std::string cells = quote + lines.substr(0, lines.size() - 1);
    reads(cells);
    reads(replaced(cells, ",", " "));
    reads("timestamp,tx,ty,tz,qx,qy,qz,qw\n" + cells);
    reads(quote + replaced("timestamp,tx,ty,tz,qx,qy,qz,qw", ",", inner) + quote + "\n" + cells);
  }
  reads(replaced(north, "\n", " \r\n\r\n"));
}

TEST(PoseSeries, LeavesOutWhatIsNoPoseAndSaysSo) {
  const TemporaryFolder folder;
  const auto says = [&](const std::string& text, const char* what) {
    const auto series = vo::read_pose_series(folder.write("t.tum", text));
    expect_north(series, text);
    ASSERT_EQ(series.warnings.size(), 1U) << text;
    EXPECT_THAT(series.warnings[0], HasSubstr(what));
  };
  const std::string north(kNorth);
  says(north + "0.8 nan nan nan 0 0 0 1\n", "1 of 5 lines are left out; the first: ");
  says(north + "0.8 nan nan nan 0 0 0 1\n", "line 5 'nan' is no number");
  says("0.1 0 0\n" + north, "line 1 has 3 numbers");
  says(north + "0.8 0 1.2 0 0 0 0 0\n", "has a quaternion of zeros");
}

TEST(PoseSeries, SortsAndKeepsTheFirstOfEqualTimes) {
  const TemporaryFolder folder;
  const std::string north(kNorth);
  const std::size_t half = north.find("0.4");
  const auto unsorted =
      vo::read_pose_series(folder.write("u.tum", north.substr(half) + north.substr(0, half)));
  expect_north(unsorted, "unsorted");
  EXPECT_THAT(unsorted.warnings, ElementsAre(HasSubstr("u.tum: 1 times are before")));
  const auto doubled = vo::read_pose_series(folder.write("d.tum", north + "0.6 7 7 7 0 0 0 1\n"));
  expect_north(doubled, "doubled");
  EXPECT_THAT(doubled.warnings, ElementsAre(HasSubstr("has the time 0.6 s twice")));
}

TEST(PoseSeries, NormalisesQuaternionsOfAnyLength) {
  const TemporaryFolder folder;
  const auto series = vo::read_pose_series(folder.write("t.tum", replaced(kNorth, "0.70710678", "1.9")));
  expect_north(series, "1.9");
  EXPECT_THAT(series.warnings, ElementsAre(HasSubstr("4 quaternions are not of length 1; normalised")));
}

TEST(PoseSeries, ConvertsClocksThatCountFasterThanSeconds) {
  const TemporaryFolder folder;
  const auto reads = [&](const std::vector<std::string>& times, const char* unit, double first_s) {
    std::string text;
    for (std::size_t i = 0; i < times.size(); ++i)
      text += fmt::format("{} {} 0 0 0 0 0 1\n", times[i], 0.3 * static_cast<double>(i));
    const auto series = vo::read_pose_series(folder.write("t.tum", text));
    // A double holds nanoseconds since 1970 to a quarter of a microsecond.
    EXPECT_NEAR(series.time_s[0], first_s, 1e-6) << unit;
    EXPECT_NEAR(series.time_s[1] - series.time_s[0], 0.05, 1e-6) << unit;
    EXPECT_THAT(series.warnings, ElementsAre(HasSubstr(fmt::format("times in {}, converted", unit))));
  };
  reads({"1403636579763555584", "1403636579813555584"}, "nanoseconds", 1403636579.763555584);
  reads({"1403636579763555", "1403636579813555"}, "microseconds", 1403636579.763555);
  reads({"1403636579763", "1403636579813"}, "milliseconds", 1403636579.763);
  reads({"0", "50000000", "100000000"}, "nanoseconds", 0);
  reads({"3600000000000", "3600050000000"}, "nanoseconds", 3600);
  reads({"0", "50000", "100000"}, "microseconds", 0);
  reads({"0", "50", "100"}, "milliseconds", 0);
}

TEST(PoseSeries, AColumnMaySayWhatItsTimesAreIn) {
  const TemporaryFolder folder;
  for (const auto& [name, per_second] :
       {std::pair("time_ms", 1e3), std::pair("timestamp_us", 1e6), std::pair("timestamp [ns]", 1e9)}) {
    const auto series = vo::read_pose_series(
        folder.write("t.csv", fmt::format("{},x_m,y_m\n0,0,0\n{},0,0\n", name, 0.25 * per_second)));
    EXPECT_THAT(series.time_s, ElementsAre(0, 0.25)) << name;
  }
}

TEST(PoseSeries, ReadsEuRoc) {
  const TemporaryFolder folder;
  const auto series =
      vo::read_pose_series(folder.write("data.csv",
                                        "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w "
                                        "[],q_RS_x [],q_RS_y [],q_RS_z [],b [rad]\n"
                                        "1000000000,1,2,3,0.5,0.5,0.5,0.5,9\n1005000000,4,5,6,1,0,0,0,9\n"));
  EXPECT_THAT(series.time_s, ElementsAre(1, 1.005));
  EXPECT_EQ(series.poses[1].position, cv::Vec3d(4, 5, 6));
  // w first: a third of a turn about (1, 1, 1) takes x to y.
  EXPECT_LT(cv::norm(series.poses[0].rotation * cv::Vec3d(1, 0, 0) - cv::Vec3d(0, 1, 0)), 1e-12);
  EXPECT_THAT(series.warnings, ElementsAre(HasSubstr("times in nanoseconds, converted to seconds")));
  const std::string single =
      "'#timestamp [ns]','p_RS_R_x [m]','p_RS_R_y [m]','p_RS_R_z [m]','q_RS_w []','q_RS_x []','q_RS_y "
      "[]','q_RS_z []'\n'1000000000','1','2','3','1','0','0','0'\n'1005000000','4','5','6','1','0','0','0'\n";
  for (const std::string& text : {single, "#" + replaced(single, "#", "")}) {
    EXPECT_THAT(vo::read_pose_series(folder.write("data.csv", text)).time_s, ElementsAre(1, 1.005)) << text;
  }
}

TEST(PoseSeries, ReadsKittiWithAndWithoutTimes) {
  const TemporaryFolder folder;
  const std::string two = "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 1 7 0 1 0 8 -1 0 0 9\n";
  const auto poses = folder.write("p.txt", two);
  const vo::PoseSeries series = vo::read_pose_series(poses);
  EXPECT_THAT(series.time_s, IsEmpty());
  EXPECT_THAT(series.frame, ElementsAre(0, 1));
  ASSERT_EQ(series.poses.size(), 2U);
  EXPECT_EQ(series.poses[1].position, cv::Vec3d(7, 8, 9));
  EXPECT_LT(cv::norm(series.poses[1].rotation - turned(std::numbers::pi / 2).rotation), 1e-12);
  const auto timed = [&](const char* times) {
    return vo::read_pose_series(poses, {.kitti_times = folder.write("t.txt", times)});
  };
  EXPECT_THAT(timed("0\n0.1\n").time_s, ElementsAre(0, 0.1));
  EXPECT_THROW_WITH(timed("0\n"), vo::Error, "t.txt: has 1 times; expected 2, one for each pose");
  EXPECT_THROW_WITH(timed("0 1\n2\n"), vo::Error, "has 2 numbers");
  // A line that is no pose leaves its frame without one.
  const auto gap = vo::read_pose_series(folder.write("g.txt", two + "nan 0 0\n" + two));
  EXPECT_THAT(gap.frame, ElementsAre(0, 1, 3, 4));
  EXPECT_EQ(gap.frames, 5U);
  EXPECT_THAT(gap.warnings, ElementsAre(HasSubstr("1 of 5 lines")));
}

TEST(PoseSeries, ReadsCsvAsFarAsItGoes) {
  const TemporaryFolder folder;
  const auto plain = vo::read_pose_series(folder.write("p.csv", "time_s,x_m,y_m\n0,1,2\n1,3,4\n"));
  EXPECT_EQ(plain.axes, vo::BodyAxes::kNone);
  EXPECT_EQ(plain.poses[1].position, cv::Vec3d(3, 4, 0));
  const auto headed =
      vo::read_pose_series(folder.write("h.csv", "time_s,x_m,y_m,z_m,heading_deg\n0,1,2,3,90\n"));
  EXPECT_EQ(headed.axes, vo::BodyAxes::kVehicle);
  EXPECT_LT(cv::norm(headed.poses[0].rotation * cv::Vec3d(1, 0, 0) - cv::Vec3d(1, 0, 0)), 1e-12);  // east
  EXPECT_EQ(headed.poses[0].position[2], 3);
  const auto turned_one =
      vo::read_pose_series(folder.write("q.csv", "time_s;x_m;y_m;qx;qy;qz;qw\n0,5;0;0;0;1;0;0\n"),
                           {.axes = vo::TrajectoryAxes::kVehicle});
  EXPECT_THAT(turned_one.time_s, ElementsAre(0.5));
  EXPECT_EQ(turned_one.axes, vo::BodyAxes::kVehicle);
  EXPECT_LT(cv::norm(turned_one.poses[0].rotation - cv::Matx33d::diag({-1, 1, -1})), 1e-12);
}

TEST(PoseSeries, NamesTheLineThatIsWrong) {
  const TemporaryFolder folder;
  const auto refused = [&](const char* text, const char* says) {
    EXPECT_THROW_WITH(vo::read_pose_series(folder.write("f", text)), vo::Error, says);
  };
  refused("", "has no pose; expected TUM's");
  refused("1 2 3\n", "f: line 1: has 3 numbers; expected TUM's lines of 8");
  refused("# c\n0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n", "f: line 3: has 7 numbers");
  refused("0 0 0 0 0 0 0 x\n", "'x' is no number");
  refused("\x7f\x02\xffz\n", "line 1: '???z' is no number");
  refused("0 0 0 0 0 0 0 0\n", "has a quaternion of zeros");
  refused("1 0 0 0 0 1 0 0 0 0 1\n1\n", "has 11 numbers");
  refused("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1\n", "line 2: has 11 numbers");
  refused("2 0 0 0 0 1 0 0 0 0 1 0\n", "is no rotation");
  refused("-1 0 0 0 0 1 0 0 0 0 1 0\n", "is no rotation");
  refused("time_s,x_m\n0,1\n", "has no column 'y_m'");
  refused("time_s,x_m,y_m\n", "has no pose");
  EXPECT_THROW_WITH(vo::read_pose_series(folder / "none"), vo::Error, "none: does not exist");
  const auto tum = folder.write("t", std::string(kNorth));
  EXPECT_THROW_WITH(vo::read_pose_series(tum, {.kitti_times = tum}), vo::Error, "has times of its own");
}

TEST(PoseSeries, ShowsAWalkOnTheGround) {
  const TemporaryFolder folder;
  // East, a metre a second: a vehicle in a world with z up, a camera in a world with y down.
  std::string vehicle, camera;
  for (int i = 0; i < 10; ++i) {
    vehicle += fmt::format("{} {} 5 1 0 0 0 1\n", i, i);
    camera += fmt::format("{} {} -1 5 0 0.70710678 0 0.70710678\n", i, i);
  }
  for (const std::string& text : {vehicle, camera}) {
    const auto walk = vo::planar(vo::read_pose_series(folder.write("w.tum", text)));
    ASSERT_EQ(walk.size(), 10U);
    EXPECT_DOUBLE_EQ(walk[9].pose.x_m, 9);
    EXPECT_DOUBLE_EQ(walk[9].pose.y_m, 5);
    EXPECT_NEAR(walk[9].pose.heading_rad, std::numbers::pi / 2, 1e-7);  // eight digits
  }
  // Said instead of found: the same camera, taken for a vehicle.
  const auto said =
      vo::planar(vo::read_pose_series(folder.write("w.tum", camera), {.axes = vo::TrajectoryAxes::kVehicle}));
  EXPECT_DOUBLE_EQ(said[9].pose.y_m, -1);
  const auto up = folder.write("up.tum", "0 0 0 0 0 0 0 1\n1 0 2 2 0 0 0 1\n2 1 4 4 0 0 0 1\n");
  EXPECT_THROW_WITH(vo::planar(vo::read_pose_series(up)), vo::Error,
                    "up.tum: does not show which of its axes is up; expected --axes");
  EXPECT_NO_THROW(vo::planar(vo::read_pose_series(up, {.axes = vo::TrajectoryAxes::kCamera})));
  EXPECT_THROW(vo::planar({.poses = {{}}}), std::invalid_argument);
}

}  // namespace
