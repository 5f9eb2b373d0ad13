#include "odometry_table.hpp"

#include <gtest/gtest.h>

namespace {

TEST(OdometryTable, SaysStepsDistanceAndWhatWasAskedFor) {
  vo::Walk walk;
  walk.source = "walk.mp4";
  walk.time_s = {0, 0.5, 1};
  vo::WalkMotion walked;
  walked.metric = true;
  walked.pedestrian.emplace();
  walked.pedestrian->detection.steps.resize(12);
  walked.pedestrian->detection.bridged = 2;
  walked.pedestrian->signal.bridged = 1;
  retrace::WrittenOdometry written;
  written.distance = 8.4;
  written.unit = "m";
  EXPECT_EQ(odometry_table(walk, walked, 0.7, written, {}),
            "walk.mp4\n"
            "  steps             12   2 of them bridged\n"
            "  distance       8.4 m   steps of 0.700 m\n"
            "  duration       1.0 s   3 frames, 1 with too few points\n");
  walked.metric = false;
  written.unit = "s";
  place::ClosedLoops loops;
  loops.loops = 5;
  loops.believed = 4;
  retrace::OdometryExtras extras;
  extras.imu_steps = 13;
  extras.loops = &loops;
  EXPECT_EQ(odometry_table(walk, walked, 0.7, written, extras),
            "walk.mp4\n"
            "  steps             12   2 of them bridged\n"
            "  imu               13   steps by the camera's accelerometer\n"
            "  distance       8.4 s   no steps, so no metres: see --camera-height-m\n"
            "  duration       1.0 s   3 frames, 1 with too few points\n"
            "  loops              5   places seen before, 4 of them believed\n");
}

}  // namespace
