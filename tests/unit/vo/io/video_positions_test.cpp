#include "support/gpmf_pieces.hpp"
#include "support/replaced.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/video_positions.hpp>

namespace {

using namespace test_support;

TEST(VideoPositions, AreSpreadOverTheirPieces) {
  const TemporaryFolder folder;
  // Two positions in the first second, nothing but a fix to come in the second, four in the third.
  write_video(folder / "walk.mp4", 75,
              {.telemetry = {gps5_piece({{51.5, -0.25}, {51.6, -0.25}}), gps5_piece({{0, 0}}, 0),
                             gps5_piece({{51.7, -0.25}, {51.8, -0.25}, {51.9, -0.25}, {52, -0.25}}),
                             "DEVC\1\1\xFF\xFF"}});
  const vo::VideoPositions found = vo::read_video_positions(folder / "walk.mp4");
  ASSERT_EQ(found.positions.size(), 6U);
  const std::vector<double> times_s{0, 0.5, 2, 2.25, 2.5, 2.75};
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    EXPECT_NEAR(found.positions[i].time_s, times_s[i], 0.001) << i;
    EXPECT_NEAR(found.positions[i].latitude_deg, 51.5 + 0.1 * static_cast<double>(i), 1e-7) << i;
  }
  EXPECT_EQ(found.without_fix, 1U);
  EXPECT_EQ(found.damaged, 1U);
}

TEST(VideoPositions, RefusesAVideoWithoutAndWhatIsNone) {
  const TemporaryFolder folder;
  write_video(folder / "walk.mp4", 5);
  EXPECT_THROW_WITH(vo::read_video_positions(folder / "walk.mp4"), vo::Error, "walk.mp4: has no GPS track");
  EXPECT_THROW_WITH(vo::read_video_positions(folder.write("text.mp4", "text\n")), vo::Error,
                    "text.mp4: is no video");
}

}  // namespace
