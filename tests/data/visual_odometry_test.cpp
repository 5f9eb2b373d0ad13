#include "support/shared_data.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <place/evaluation/kitti_evaluation.hpp>
#include <vo/io/frame_source.hpp>
#include <vo/io/pose_series_io.hpp>
#include <vo/io/trajectory_io.hpp>
#include <vo/visual_odometry/monocular_vo.hpp>

namespace {

namespace fs = std::filesystem;

vo::DisplacementTrack track_of(const fs::path& video, const vo::MonocularVoOptions& options) {
  const auto frames = vo::open_frame_source(video.string());
  vo::MonocularVo odometry(options);
  while (const auto frame = frames->next()) odometry.push(frame->image, frame->time_s);
  return odometry.finish();
}

std::size_t lost(const vo::DisplacementTrack& track) {
  return static_cast<std::size_t>(std::ranges::count(track.frames, false, &vo::TrackedDisplacement::valid));
}

class OnRecordings : public testing::Test {
 protected:
  void SetUp() override {
    data_ = test_support::data_folder();
    if (!data_) GTEST_SKIP() << "no data folder: set RETRACE_DATA";
  }
  std::optional<fs::path> data_;
};

class VisualOdometryOnKitti : public OnRecordings {};
class VisualOdometryOnWalks : public OnRecordings, public testing::WithParamInterface<const char*> {};

TEST_F(VisualOdometryOnKitti, DriftsLessThanFivePercent) {
  vo::MonocularVoOptions options;
  options.camera = vo::Camera{.width_px = 1242,
                              .height_px = 374,
                              .fx_px = 721.5377,
                              .fy_px = 721.5377,
                              .cx_px = 609.5593,
                              .cy_px = 172.854};  // K.txt
  vo::DisplacementTrack track = track_of(*data_ / "kitti_03" / "drive.mp4", options);
  const vo::PoseSeries truth = vo::read_pose_series(*data_ / "kitti_03" / "poses_kitti.txt");
  const std::optional<double> metres = place::metres_per_unit(truth.poses, track.poses, 50);
  ASSERT_TRUE(metres);
  for (auto& pose : track.poses) {
    if (pose) pose->position *= *metres;
  }
  const place::KittiEvaluation evaluation = place::evaluate_kitti(truth.poses, track.poses);
  std::printf("  kitti_03: %zu of %zu frames lost; translation %.2f %%, rotation %.4f deg/m\n", lost(track),
              track.size(), evaluation.all.translation_pct, evaluation.all.rotation_deg_per_m);
  EXPECT_EQ(lost(track), 0U);
  EXPECT_EQ(evaluation.unknown, 0U);
  EXPECT_LE(evaluation.all.translation_pct, 5);
  EXPECT_LE(evaluation.all.rotation_deg_per_m, 0.01);
}

/// Simulated walks: what is lost, and how much the scale drifts within a segment.
TEST_P(VisualOdometryOnWalks, HoldsItsScale) {
  const std::string name = GetParam();
  const vo::DisplacementTrack track = track_of(*data_ / "sim" / (name + ".mp4"), {});
  const vo::WalkTruth truth = vo::read_truth(*data_ / "sim" / (name + ".csv"));
  ASSERT_EQ(track.size(), truth.frame.size());
  const double share_lost = static_cast<double>(lost(track)) / static_cast<double>(track.size());
  std::printf("  %s: %.1f %% lost\n", name.c_str(), 100 * share_lost);
  EXPECT_LE(share_lost, name == "street_night" ? 0.3 : 0.1);
  for (int segment = 0; segment <= track.frames.back().segment; ++segment) {
    // Metres to a unit over each fifth of the way.
    std::vector<double> way, true_way;
    for (std::size_t i = 1; i < track.size(); ++i) {
      if (!track.frames[i].valid || track.frames[i].segment != segment) continue;
      way.push_back(track.frames[i].displacement);
      true_way.push_back(*truth.distance_m[i] - *truth.distance_m[i - 1]);
    }
    constexpr std::size_t kParts = 5, kLeastFrames = 250;
    if (way.size() < kLeastFrames) continue;
    std::printf("    segment of %zu frames, metres to a unit:", way.size());
    std::vector<double> scales;
    for (std::size_t part = 0; part < kParts; ++part) {
      const auto sum = [&](const std::vector<double>& values) {
        const auto at = [&](std::size_t p) {
          return values.begin() + static_cast<std::ptrdiff_t>(p * values.size() / kParts);
        };
        return std::accumulate(at(part), at(part + 1), 0.0);
      };
      if (sum(true_way) < 2) continue;  // it stands
      scales.push_back(sum(true_way) / sum(way));
      std::printf(" %.2f", scales.back());
    }
    std::printf("\n");
    const auto [least, most] = std::ranges::minmax(scales);
    EXPECT_LE(most / least, 1.4) << name << " segment " << segment;
  }
}

INSTANTIATE_TEST_SUITE_P(Sim, VisualOdometryOnWalks,
                         testing::Values("street_day", "street_night", "corridor_a", "corridor_b", "run",
                                         "stand_walk"),
                         [](const auto& walk) { return std::string(walk.param); });

}  // namespace
