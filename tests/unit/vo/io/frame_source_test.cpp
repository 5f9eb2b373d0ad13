#include "support/temporary_folder.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>

namespace {

using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

/// Frames of 64x48, all alike or, without `picture`, of a brightness that tells their number.
void write_video(const std::filesystem::path& path, int frames, double rate_hz, const char* codec = "MJPG",
                 const cv::Mat& picture = {}) {
  cv::VideoWriter writer(path.string(), cv::CAP_FFMPEG,
                         cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]), rate_hz, {64, 48});
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < frames; ++i)
    writer.write(picture.empty() ? cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(10 * i)) : picture);
}

cv::Mat half_black_half_white() {
  cv::Mat picture(48, 64, CV_8UC3, cv::Scalar::all(0));
  picture.colRange(32, 64).setTo(cv::Scalar::all(255));
  return picture;
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

TEST(FrameSource, ReadsAVideoWithItsTimes) {
  const TemporaryFolder folder;
  write_video(folder / "walk.avi", 12, 20);
  const auto source = vo::open_frame_source((folder / "walk.avi").string());
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 12U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].index, static_cast<std::int64_t>(i));
    EXPECT_NEAR(frames[i].time_s, static_cast<double>(i) / 20, 1e-3);  // containers keep milliseconds
    EXPECT_EQ(frames[i].image.type(), CV_8UC1);
    EXPECT_NEAR(frames[i].image.at<uchar>(20, 20), 10 * i, 4);  // JPEG's loss on a plain picture
  }
  EXPECT_TRUE(source->warnings().empty());
}

TEST(FrameSource, GreyOfAVideoGoesFromBlackToWhite) {
  const TemporaryFolder folder;
  // MPEG-4 keeps luma from 16 to 235.
  write_video(folder / "walk.mp4", 2, 20, "mp4v", half_black_half_white());
  const auto frames = read_all(*vo::open_frame_source((folder / "walk.mp4").string()));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_LE(frames[0].image.at<uchar>(24, 8), 2);
  EXPECT_GE(frames[0].image.at<uchar>(24, 56), 253);
}

TEST(FrameSource, GivesSmallPicturesInColourWhereTheyAreAskedFor) {
  const TemporaryFolder folder;
  const cv::Vec3b colour(30, 90, 200);
  const std::string path = (folder / "walk.mp4").string();
  write_video(path, 1, 20, "mp4v", cv::Mat(48, 64, CV_8UC3, cv::Scalar(colour)));
  EXPECT_TRUE(vo::open_frame_source(path)->next()->colour.empty());
  EXPECT_EQ(vo::open_frame_source(path, {.colour_width_px = 100})->next()->colour.size(), cv::Size(64, 48));
  const cv::Mat small = vo::open_frame_source(path, {.colour_width_px = 32})->next()->colour;
  ASSERT_EQ(small.size(), cv::Size(32, 24));
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(small.at<cv::Vec3b>(12, 16)[c], colour[c], 6) << c;  // MPEG-4's loss
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
  ASSERT_FALSE(source->warnings().empty());
  EXPECT_THAT(source->warnings()[0], HasSubstr("cut.avi: breaks off: " + std::to_string(frames.size()) +
                                               " of 40 frames could be read"));
}

TEST(FrameSource, ADamagedLastFrameIsNoBreak) {
  const TemporaryFolder folder;
  write_video(folder / "whole.avi", 40, 20);
  std::string bytes = test_support::read_file(folder / "whole.avi");
  const std::size_t last = bytes.rfind("\xFF\xD8\xFF"), end = bytes.rfind("idx1");
  ASSERT_LT(last, end);
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(last),
            bytes.begin() + static_cast<std::ptrdiff_t>(end), '\0');
  const auto source = vo::open_frame_source(folder.write("damaged.avi", bytes).string());
  EXPECT_EQ(read_all(*source).size(), 39U);
  for (const std::string& warning : source->warnings())
    EXPECT_THAT(warning, testing::Not(HasSubstr("breaks off")));
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
  EXPECT_THROW(vo::open_frame_source(folder.path().string(), {.frame_rate_hz = 0}), std::invalid_argument);
  EXPECT_THROW(vo::open_frame_source(folder.path().string(), {.frame_rate_hz = -1}), std::invalid_argument);
  EXPECT_THROW(vo::open_frame_source(folder.path().string(), {.colour_width_px = -1}), std::invalid_argument);
}

TEST(FrameSource, RefusesACameraThatIsNotThere) {
  EXPECT_THROW_WITH(vo::open_frame_source("camera:99"), vo::Error, "camera:99: cannot be opened");
}

}  // namespace
