#include "imu_steps.hpp"

#include "support/gpmf_pieces.hpp"
#include "support/replaced.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using namespace test_support;

TEST(ImuSteps, AreThoseOfTheWalksOwnVideo) {
  const TemporaryFolder folder;
  std::vector<std::string> pieces;
  constexpr int kSeconds = 10, kRate = 100;
  for (int second = 0; second < kSeconds; ++second) {  // 2 steps a second
    std::vector<std::array<double, 3>> values;
    for (int i = 0; i < kRate; ++i)
      values.push_back({0, -9.81 - 2 * std::sin(2 * std::numbers::pi * 2 * i / kRate), 0});
    pieces.push_back(accl_piece(values));
  }
  write_video(folder / "walk.mp4", 25 * kSeconds, {.telemetry = pieces});
  vo::Walk walk;
  walk.source = (folder / "walk.mp4").string();
  EXPECT_NEAR(static_cast<double>(retrace::imu_steps("video", walk)), 2 * kSeconds, 1);
  EXPECT_THROW_WITH(retrace::imu_steps("phone.csv", walk), vo::Error,
                    "--imu: is 'phone.csv'; expected video");
  walk.source = folder.path().string();
  EXPECT_THROW_WITH(retrace::imu_steps("video", walk), vo::Error, "expected a walk of one video file");
}

}  // namespace
