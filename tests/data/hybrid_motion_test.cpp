#include "support/shared_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <vo/io/pose_series_io.hpp>
#include <vo/motion/walk_motion.hpp>

/// A real drive with frames blanked: the length of hybrid motion, scaled by the truth's first 50 m.
namespace {

constexpr std::size_t kStretches = 3;
constexpr std::size_t kBlank = 27;  // frames each, 2.7 s: 10 % of the drive in all

/// A recording whose frames are black from some on.
class Blanked final : public vo::FrameSource {
 public:
  Blanked(std::unique_ptr<vo::FrameSource> frames, std::array<std::size_t, kStretches> begins)
      : frames_(std::move(frames)), begins_(begins) {}

  std::optional<vo::Frame> next() override {
    std::optional<vo::Frame> frame = frames_->next();
    const std::size_t index = index_++;
    const auto blank = [&](std::size_t begin) { return index >= begin && index < begin + kBlank; };
    if (frame && std::ranges::any_of(begins_, blank)) frame->image.setTo(0);
    return frame;
  }

 private:
  std::unique_ptr<vo::FrameSource> frames_;
  std::array<std::size_t, kStretches> begins_;
  std::size_t index_ = 0;
};

class HybridMotionOnKitti : public testing::TestWithParam<std::array<std::size_t, kStretches>> {};

TEST_P(HybridMotionOnKitti, KeepsItsLengthThroughBlanks) {
  const auto data = test_support::data_folder();
  if (!data) GTEST_SKIP() << "no data folder: set RETRACE_DATA";
  const std::filesystem::path folder = *data / "kitti_03";
  const vo::PoseSeries truth = vo::read_pose_series(folder / "poses_kitti.txt");
  vo::WalkOptions reading{.preview_width_px = 0};
  vo::keep_for(vo::MotionSource::kHybrid, reading);
  reading.vo.camera = vo::Camera{.width_px = 1242,
                                 .height_px = 374,
                                 .fx_px = 721.5377,
                                 .fy_px = 721.5377,
                                 .cx_px = 609.5593,
                                 .cy_px = 172.854};  // K.txt
  Blanked drive(vo::open_frame_source((folder / "drive.mp4").string()), GetParam());
  const vo::Walk walk = vo::read_walk(drive, "a drive with blanks", reading);
  const std::vector<double> moved = vo::displacements(vo::walk_motion(walk, vo::MotionSource::kHybrid));
  ASSERT_EQ(moved.size(), truth.poses.size());

  double true_m = 0, said = 0, metres_per_unit = 0, tracked_m = 0;
  for (std::size_t i = 1; i < moved.size(); ++i) {
    const double way_m = cv::norm(truth.poses[i].position - truth.poses[i - 1].position);
    true_m += way_m;
    said += moved[i];
    tracked_m += walk.track->frames[i].valid ? way_m : 0;
    if (metres_per_unit == 0 && true_m >= 50) metres_per_unit = true_m / said;
  }
  const double error = said * metres_per_unit / true_m - 1;
  std::printf(
      "  kitti_03 blanked from frames %zu, %zu, %zu: hybrid's length is off by %.1f %%, visual "
      "odometry knows %.0f %% of the way\n",
      GetParam()[0], GetParam()[1], GetParam()[2], 100 * error, 100 * tracked_m / true_m);
  EXPECT_LE(std::abs(error), 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    Blanks, HybridMotionOnKitti,
    testing::Values(std::array<std::size_t, 3>{150, 400, 650}, std::array<std::size_t, 3>{100, 300, 500},
                    std::array<std::size_t, 3>{250, 470, 720}, std::array<std::size_t, 3>{200, 260, 600},
                    std::array<std::size_t, 3>{11, 198, 394}, std::array<std::size_t, 3>{19, 88, 560}));

}  // namespace
