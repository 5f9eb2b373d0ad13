#include "support/temporary_folder.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/trajectory_io.hpp>

namespace {

using test_support::read_file;
using test_support::TemporaryFolder;
using testing::ElementsAre;

constexpr double kDegree = std::numbers::pi / 180;

TEST(AtomicFile, WritesWholeOrNotAtAll) {
  const TemporaryFolder folder;
  vo::write_file(folder / "a.txt", "one");
  EXPECT_EQ(read_file(folder / "a.txt"), "one");
  {
    const vo::AtomicFile file(folder / "a.txt");
    std::ofstream(file.temporary()) << "half";
  }
  EXPECT_EQ(read_file(folder / "a.txt"), "one");
  vo::write_file(folder / "a.txt", "two");
  EXPECT_EQ(read_file(folder / "a.txt"), "two");
  // Nothing but the file is left behind.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(AtomicFile, SaysWhyItCannotWrite) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::write_file(folder / "none" / "a.txt", "x"), vo::Error,
                    "a.txt: cannot be written: No such file");
}

TEST(Csv, ReadsColumnsByName) {
  const TemporaryFolder folder;
  const auto table = vo::CsvTable::read(folder.write("t.csv",
                                                     "\xEF\xBB\xBF"
                                                     "a, b,c\r\n1,2.5,x\r\n\r\n3,,y\r\n"));
  EXPECT_EQ(table.rows(), 2U);
  EXPECT_TRUE(table.has("b"));
  EXPECT_THAT(table.indices("a"), ElementsAre(1, 3));
  EXPECT_THAT(table.text("c"), ElementsAre("x", "y"));
  EXPECT_THAT(table.optional_numbers("b"), ElementsAre(2.5, std::nullopt));
  EXPECT_THROW_WITH(table.numbers("b"), vo::Error, "t.csv: line 4: b is empty; expected a finite number");
  EXPECT_THROW_WITH(table.numbers("c"), vo::Error, "t.csv: line 2: c is 'x'");
  EXPECT_THROW_WITH(table.numbers("d"), vo::Error,
                    "t.csv: has no column 'd'; expected it among those there are (a, b, c)");
}

TEST(Csv, NamesTheLineThatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "a,b\n1,2\n3\n")), vo::Error,
                    "t.csv: line 3: has 1 cells; expected 2 as in the header");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "\n\n")), vo::Error, "t.csv: is empty");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder / "none.csv"), vo::Error, "none.csv: does not exist");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "a\n1\n-2\n")).indices("a"), vo::Error,
                    "t.csv: line 3: a is -2; expected a whole number, 0 or greater");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "a\n1\n1.5\n")).indices("a"), vo::Error,
                    "a is 1.5");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "a\nnan\n")).numbers("a"), vo::Error,
                    "a is 'nan'");
}

TEST(Truth, ReadsFramesInOrder) {
  const TemporaryFolder folder;
  const std::string header = "frame,time_s,x_m,y_m,heading_deg,distance_m,steps\n";
  const vo::WalkTruth truth =
      vo::read_truth(folder.write("t.csv", header + "0,0,1,2,90,0,0\n1,0.04,1.5,2,-270,0.5,1\n"));
  EXPECT_THAT(truth.distance_m, ElementsAre(0, 0.5));
  EXPECT_THAT(truth.steps, ElementsAre(0, 1));
  EXPECT_NEAR(truth.poses[1].pose.heading_rad, 90 * kDegree, 1e-12);
  EXPECT_DOUBLE_EQ(truth.poses[1].pose.x_m, 1.5);

  EXPECT_THROW_WITH(vo::read_truth(folder.write("t.csv", header)), vo::Error, "has no rows");
  EXPECT_THROW_WITH(vo::read_truth(folder.write("t.csv", header + "1,0,0,0,0,0,0\n")), vo::Error,
                    "line 2: frame is 1; expected 0");
  EXPECT_THROW_WITH(vo::read_truth(folder.write("t.csv", header + "0,1,0,0,0,0,0\n1,1,0,0,0,0,0\n")),
                    vo::Error, "line 3: time 1 s does not follow 1 s");
  EXPECT_THROW_WITH(vo::read_truth(folder.write("t.csv", "frame,time_s\n0,0\n")), vo::Error, "has no column");
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

TEST(Tum, NamesTheLineThatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::read_tum(folder.write("t.tum", "# c\n0 0 0 0 0 0 0\n")), vo::Error,
                    "t.tum: line 2: is not 8 numbers");
  EXPECT_THROW_WITH(vo::read_tum(folder.write("t.tum", "0 0 0 0 0 0 0 1 9\n")), vo::Error,
                    "more than 8 cells");
  EXPECT_THROW_WITH(vo::read_tum(folder.write("t.tum", "0 0 0 0 0 0 0 0\n")), vo::Error,
                    "no unit quaternion");
  EXPECT_THROW_WITH(vo::read_tum(folder.write("t.tum", "1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n")), vo::Error,
                    "line 2: time 0 s does not follow 1 s");
  EXPECT_THROW_WITH(vo::read_tum(folder.write("t.tum", "\n")), vo::Error, "has no pose");
  EXPECT_THROW_WITH(vo::read_tum(folder / "none"), vo::Error, "cannot be read");
}

}  // namespace
