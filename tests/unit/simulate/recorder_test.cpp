#include "simulate/recorder.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include <vo/base/error.hpp>

namespace simulate {
namespace {

namespace fs = std::filesystem;

class Recorder : public testing::Test {
 protected:
  Recorder() {
    options_.scene = Scene::kCorridor;
    options_.length_m = 5;
    options_.size = {64, 36};
    options_.frame_rate_hz = 10;
  }
  ~Recorder() override { fs::remove_all(directory_); }

  Options options_;
  fs::path directory_ =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Recorder, WritesAVideoAndARowForEachFrame) {
  const Recording recording = simulate_walk(options_, directory_, false);
  cv::VideoCapture video((directory_ / "walk.mp4").string());
  ASSERT_TRUE(video.isOpened());
  EXPECT_DOUBLE_EQ(video.get(cv::CAP_PROP_FPS), 10);
  int frames = 0;
  for (cv::Mat frame; video.read(frame); ++frames) EXPECT_EQ(frame.size(), cv::Size(64, 36));
  EXPECT_EQ(frames, recording.frames);

  std::ifstream truth(directory_ / "truth.csv");
  std::string line;
  ASSERT_TRUE(std::getline(truth, line));
  EXPECT_EQ(line, "frame,time_s,x_m,y_m,heading_deg,distance_m,steps");
  int rows = 0;
  while (std::getline(truth, line)) EXPECT_EQ(line.substr(0, line.find(',')), std::to_string(rows++));
  EXPECT_EQ(rows, frames);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()),
            2);  // nothing left over

  EXPECT_THROW(simulate_walk(options_, directory_, false), vo::Error);
}

TEST_F(Recorder, KeepsWhatIsDrawnWhenStoppedAndOverwritesIfTold) {
  fs::create_directories(directory_);
  std::ofstream(directory_ / "walk.mp4") << "an older walk";
  const Recording recording =
      simulate_walk(options_, directory_, true, [](const vo::Progress&) { return false; });
  EXPECT_EQ(recording.frames, 16);  // one batch
  EXPECT_TRUE(fs::exists(directory_ / "walk.mp4"));
  EXPECT_TRUE(fs::exists(directory_ / "truth.csv"));
}

TEST_F(Recorder, LeavesNothingBehindIfOptionsAreWrong) {
  options_.people = -1;
  EXPECT_THROW(simulate_walk(options_, directory_, false), vo::Error);
  EXPECT_FALSE(fs::exists(directory_));
}

}  // namespace
}  // namespace simulate
