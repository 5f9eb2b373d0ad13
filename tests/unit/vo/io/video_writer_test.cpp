#include "vo/io/video_writer.hpp"

#include "support/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>

namespace {

namespace fs = std::filesystem;
using test_support::TemporaryFolder;

/// A grey level that rises with the number of the picture, and a blue square.
cv::Mat picture_of(int number, cv::Size size = {64, 48}) {
  cv::Mat picture(size, CV_8UC3, cv::Scalar::all(40 + 5 * number));
  picture(cv::Rect(0, 0, 16, 16)).setTo(cv::Scalar(250, 20, 20));
  return picture;
}

void write(const fs::path& path, int pictures, double rate_hz = 25) {
  vo::VideoWriter writer(path, {64, 48}, rate_hz);
  for (int i = 0; i < pictures; ++i) writer.write(picture_of(i));
  writer.finish();
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(VideoWriter, EveryPictureIsReadBackAtItsTimeWithItsColours) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mp4";
  write(path, 30, 12.5);
  const auto source = vo::open_frame_source(path.string(), {.colour_width_px = 64});
  EXPECT_EQ(source->expected_frames(), 30);
  constexpr int kCoded = 6;  // levels that the encoder may lose on an even surface
  for (int i = 0; i < 30; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame) << i;
    EXPECT_NEAR(frame->time_s, i / 12.5, 1e-4) << i;  // the container's clock
    EXPECT_NEAR(frame->colour.at<cv::Vec3b>(40, 50)[1], 40 + 5 * i, kCoded) << i;
    EXPECT_GT(frame->colour.at<cv::Vec3b>(6, 6)[0], 200) << i;  // blue
    EXPECT_LT(frame->colour.at<cv::Vec3b>(6, 6)[2], 60) << i;
  }
  EXPECT_FALSE(source->next());
}

TEST(VideoWriter, OnePictureIsAVideo) {
  const TemporaryFolder folder;
  write(folder.path() / "a.mp4", 1);
  const auto source = vo::open_frame_source((folder.path() / "a.mp4").string());
  EXPECT_TRUE(source->next());
  EXPECT_FALSE(source->next());
}

TEST(VideoWriter, TheSamePicturesGiveTheSameBytes) {
  const TemporaryFolder folder;
  write(folder.path() / "a.mp4", 20);
  write(folder.path() / "b.mp4", 20);
  EXPECT_EQ(bytes_of(folder.path() / "a.mp4"), bytes_of(folder.path() / "b.mp4"));
}

TEST(VideoWriter, LeavesNothingUnlessItIsFinished) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mp4";
  std::ofstream(path) << "before";
  {
    vo::VideoWriter writer(path, {64, 48}, 25);
    writer.write(picture_of(1));
  }
  EXPECT_EQ(bytes_of(path), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(VideoWriter, RefusesWhatItCannotWrite) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.mp4";
  EXPECT_THROW(vo::VideoWriter(path, {63, 48}, 25), std::invalid_argument);
  EXPECT_THROW(vo::VideoWriter(path, {64, 0}, 25), std::invalid_argument);
  EXPECT_THROW(vo::VideoWriter(path, {64, 48}, 0), std::invalid_argument);
  try {
    const vo::VideoWriter writer(folder.path() / "none" / "a.mp4", {64, 48}, 25);
    ADD_FAILURE() << "written into a folder that does not exist";
  } catch (const vo::Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("a.mp4: cannot be written: No such file"));
  }
  vo::VideoWriter writer(path, {64, 48}, 25);
  EXPECT_THROW(writer.finish(), std::invalid_argument);
  EXPECT_THROW(writer.write(picture_of(0, {32, 48})), std::invalid_argument);
  EXPECT_THROW(writer.write(cv::Mat(48, 64, CV_8UC1)), std::invalid_argument);
}

}  // namespace
