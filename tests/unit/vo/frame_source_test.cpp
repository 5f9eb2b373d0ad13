#include "support/temporary_folder.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>

namespace {

using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

void write_image(const std::filesystem::path& path, int grey, cv::Size size = {8, 4}) {
  ASSERT_TRUE(cv::imwrite(path.string(), cv::Mat(size, CV_8UC1, cv::Scalar(grey))));
}

/// Frames whose brightness tells their number.
void write_video(const std::filesystem::path& path, int frames, double rate_hz) {
  cv::VideoWriter writer(path.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), rate_hz,
                         {64, 48});
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < frames; ++i) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(10 * i)));
}

std::vector<vo::Frame> read_all(vo::FrameSource& source) {
  std::vector<vo::Frame> frames;
  while (auto frame = source.next()) frames.push_back(*frame);
  return frames;
}

TEST(NaturalLess, OrdersNumbersByValue) {
  std::vector<std::string> names{"b1", "a10", "a2", "a02", "a", "a2b", "A3"};
  std::ranges::sort(names, vo::natural_less);
  EXPECT_THAT(names, ElementsAre("A3", "a", "a02", "a2", "a2b", "a10", "b1"));
}

TEST(NaturalLess, IsAStrictWeakOrder) {
  const std::vector<std::string> names{"",     "0",   "00", "1", "01", "a",   "a0",
                                       "a00b", "a0b", "a1", "9", "10", "x-9", "x-10"};
  for (const auto& a : names) {
    EXPECT_FALSE(vo::natural_less(a, a));
    for (const auto& b : names) {
      EXPECT_EQ(a == b, !vo::natural_less(a, b) && !vo::natural_less(b, a)) << a << " " << b;
      for (const auto& c : names) {
        EXPECT_TRUE(!vo::natural_less(a, b) || !vo::natural_less(b, c) || vo::natural_less(a, c))
            << a << b << c;
      }
    }
  }
}

TEST(FrameSource, ReadsAFolderInNaturalOrder) {
  const TemporaryFolder folder;
  write_image(folder / "10.png", 100);
  write_image(folder / "2.png", 20);
  write_image(folder / "1.png", 10);
  folder.write("notes.txt", "no image");
  const auto source = vo::open_frame_source(folder.path().string(), {.image_rate_hz = 10});
  EXPECT_EQ(source->expected_frames(), 3);
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].image.at<uchar>(0, 0), 10);
  EXPECT_EQ(frames[1].image.at<uchar>(0, 0), 20);
  EXPECT_EQ(frames[2].image.at<uchar>(0, 0), 100);
  EXPECT_EQ(frames[2].index, 2);
  EXPECT_DOUBLE_EQ(frames[2].time_s, 0.2);
}

TEST(FrameSource, NamesTheImageThatDoesNotFit) {
  const TemporaryFolder folder;
  write_image(folder / "1.png", 1);
  write_image(folder / "2.png", 1, {9, 4});
  auto source = vo::open_frame_source(folder.path().string());
  source->next();
  EXPECT_THROW_WITH(source->next(), vo::Error, "2.png: is 9x4 pixels; expected 8x4 as 1.png");

  folder.write("2.png", "no png");
  source = vo::open_frame_source(folder.path().string());
  source->next();
  EXPECT_THROW_WITH(source->next(), vo::Error, "2.png: cannot be read as an image");
}

TEST(FrameSource, ReadsAVideoWithItsTimes) {
  const TemporaryFolder folder;
  write_video(folder / "walk.avi", 12, 20);
  const auto source = vo::open_frame_source((folder / "walk.avi").string());
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 12U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].index, static_cast<std::int64_t>(i));
    EXPECT_NEAR(frames[i].time_s, static_cast<double>(i) / 20, 1e-3);  // containers keep milliseconds
    EXPECT_NEAR(frames[i].image.at<cv::Vec3b>(20, 20)[0], 10 * i, 4);  // JPEG's loss on a plain picture
  }
  EXPECT_TRUE(source->warnings().empty());
}

TEST(FrameSource, SaysThatAVideoBreaksOff) {
  const TemporaryFolder folder;
  write_video(folder / "whole.avi", 40, 20);
  const std::string whole = test_support::read_file(folder / "whole.avi");
  const auto path = folder.write("cut.avi", whole.substr(0, whole.size() / 2));
  const auto source = vo::open_frame_source(path.string());
  const auto frames = read_all(*source);
  EXPECT_GT(frames.size(), 5U);
  EXPECT_LT(frames.size(), 38U);
  ASSERT_EQ(source->warnings().size(), 1U);
  EXPECT_THAT(source->warnings()[0], HasSubstr("cut.avi: breaks off: " + std::to_string(frames.size()) +
                                               " of 40 frames could be read"));
}

TEST(FrameSource, RefusesWhatIsNoWalk) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::open_frame_source((folder / "none.mp4").string()), vo::Error,
                    "none.mp4: does not exist");
  EXPECT_THROW_WITH(vo::open_frame_source(folder.write("empty.mp4", "").string()), vo::Error,
                    "is empty (0 bytes)");
  EXPECT_THROW_WITH(vo::open_frame_source(folder.write("text.mp4", "this is text\n").string()), vo::Error,
                    "text.mp4: is no video that FFmpeg can read");
  std::filesystem::create_directory(folder / "nothing");
  EXPECT_THROW_WITH(vo::open_frame_source((folder / "nothing").string()), vo::Error, "holds no image");
  EXPECT_THROW_WITH(vo::open_frame_source("camera:x"), vo::Error,
                    "camera:x: is no camera; expected camera:N");
  EXPECT_THROW_WITH(vo::open_frame_source("camera:99"), vo::Error, "camera:99: cannot be opened");
  EXPECT_THROW(vo::open_frame_source(folder.path().string(), {.image_rate_hz = 0}), std::invalid_argument);
}

}  // namespace
