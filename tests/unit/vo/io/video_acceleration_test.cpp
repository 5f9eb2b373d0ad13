#include "support/gpmf_pieces.hpp"
#include "support/replaced.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/video_acceleration.hpp>

namespace {

using namespace test_support;

TEST(VideoAcceleration, IsTheLengthOfTheVectorOverItsPiece) {
  const TemporaryFolder folder;
  write_video(
      folder / "walk.mp4", 50,
      {.telemetry = {accl_piece({{3, 4, 0}, {0, 0, -9.5}}), "DEVC\1\1\xFF\xFF", accl_piece({{0, 12, 5}})}});
  const vo::VideoAcceleration found = vo::read_video_acceleration(folder / "walk.mp4");
  ASSERT_EQ(found.time_s.size(), 3U);
  EXPECT_NEAR(found.time_s[0], 0, 0.001);
  EXPECT_NEAR(found.time_s[1], 0.5, 0.001);
  EXPECT_NEAR(found.time_s[2], 2, 0.001);
  EXPECT_NEAR(found.acceleration_m_s2[0], 5, 0.01);
  EXPECT_NEAR(found.acceleration_m_s2[1], 9.5, 0.01);
  EXPECT_NEAR(found.acceleration_m_s2[2], 13, 0.01);
  EXPECT_EQ(found.damaged, 1U);
}

TEST(VideoAcceleration, RefusesAVideoWithoutIt) {
  const TemporaryFolder folder;
  write_video(folder / "walk.mp4", 5);
  EXPECT_THROW_WITH(vo::read_video_acceleration(folder / "walk.mp4"), vo::Error,
                    "walk.mp4: has no accelerometer track");
}

}  // namespace
