#include "support/rendered_room.hpp"
#include "support/temporary_folder.hpp"

#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/pose_series_io.hpp>

namespace {

using test_support::TemporaryFolder;
using test_support::turned;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(PoseSeries, RoundTripsThroughTum) {
  const TemporaryFolder folder;
  const std::vector<std::optional<vo::Pose3>> poses{turned(0.3, {1, 2, 3}), std::nullopt,
                                                    turned(-2, {-4, 5, 6})};
  const std::string text = vo::to_tum(poses, {0, 1, 2.5}, "poses");
  EXPECT_EQ(text.substr(0, text.find('\n')), "# poses");
  const vo::PoseSeries series = vo::read_pose_series(folder.write("t.tum", text));
  EXPECT_THAT(series.time_s, ElementsAre(0, 2.5));
  EXPECT_EQ(series.axes, vo::BodyAxes::kCamera);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(cv::norm(series.poses[i].position - poses[2 * i]->position), 1e-8);  // nine decimals
    EXPECT_LT(cv::norm(series.poses[i].rotation - poses[2 * i]->rotation), 1e-7);
  }
  EXPECT_THROW(vo::to_tum(poses, {0}, ""), std::invalid_argument);
}

TEST(PoseSeries, ReadsKittiWithAndWithoutTimes) {
  const TemporaryFolder folder;
  const auto poses = folder.write("p.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 1 7 0 1 0 8 -1 0 0 9\n");
  const vo::PoseSeries series = vo::read_pose_series(poses);
  EXPECT_THAT(series.time_s, IsEmpty());
  ASSERT_EQ(series.poses.size(), 2U);
  EXPECT_EQ(series.poses[1].position, cv::Vec3d(7, 8, 9));
  EXPECT_LT(cv::norm(series.poses[1].rotation - turned(std::numbers::pi / 2).rotation), 1e-12);
  EXPECT_THAT(vo::read_pose_series(poses, {}, folder.write("t.txt", "0\n0.1\n")).time_s, ElementsAre(0, 0.1));
  EXPECT_THROW_WITH(vo::read_pose_series(poses, {}, folder.write("t.txt", "0\n")), vo::Error,
                    "t.txt: has 1 times; expected 2, one for each pose");
  EXPECT_THROW_WITH(vo::read_pose_series(poses, {}, folder.write("t.txt", "0\n0\n")), vo::Error,
                    "line 2: time 0 s");
  EXPECT_THROW_WITH(vo::read_pose_series(poses, {}, folder.write("t.txt", "0 1\n")), vo::Error,
                    "has 2 numbers");
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
  const auto turned_one = vo::read_pose_series(
      folder.write("q.csv", "time_s,x_m,y_m,qx,qy,qz,qw\n0,0,0,0,1,0,0\n"), vo::BodyAxes::kVehicle);
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
  refused("# c\n0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n", "f: line 3: has 7 numbers; expected 8");
  refused("0 0 0 0 0 0 0 x\n", "'x' is no number");
  refused("0 0 0 0 0 0 0 nan\n", "'nan' is no number");
  refused("\x7f\x02\xffz\n", "line 1: '???z' is no number");
  refused("0 0 0 0 0 0 0 0\n", "no unit quaternion");
  refused("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", "line 2: time 1 s does not follow 1 s");
  refused("1 0 0 0 0 1 0 0 0 0 1\n1\n", "has 11 numbers");
  refused("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1\n", "line 2: has 11 numbers; expected 12");
  refused("2 0 0 0 0 1 0 0 0 0 1 0\n", "is no rotation");
  refused("-1 0 0 0 0 1 0 0 0 0 1 0\n", "is no rotation");
  refused("time_s,x_m\n0,1\n", "has no column 'y_m'");
  refused("time_s,x_m,y_m\n", "has no pose");
  EXPECT_THROW_WITH(vo::read_pose_series(folder / "none"), vo::Error, "none: cannot be read");
  const auto tum = folder.write("t", "0 0 0 0 0 0 0 1\n");
  EXPECT_THROW_WITH(vo::read_pose_series(tum, {}, tum), vo::Error, "has times of its own");
}

}  // namespace
