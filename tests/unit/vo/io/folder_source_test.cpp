#include "support/temporary_folder.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>

namespace {

using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void write_image(const std::filesystem::path& path, int grey, cv::Size size = {8, 4}, int type = CV_8UC1) {
  ASSERT_TRUE(cv::imwrite(path.string(), cv::Mat(size, type, cv::Scalar::all(grey))));
}

std::vector<vo::Frame> read_all(vo::FrameSource& source) {
  std::vector<vo::Frame> frames;
  while (auto frame = source.next()) frames.push_back(*frame);
  return frames;
}

TEST(FolderSource, IsReadInNaturalOrder) {
  const TemporaryFolder folder;
  write_image(folder / "10.png", 100);
  write_image(folder / "2.png", 20);
  write_image(folder / "1.png", 10);
  folder.write("notes.txt", "no image");
  const auto source = vo::open_frame_source(folder.path().string(), {.frame_rate_hz = 10});
  EXPECT_EQ(source->expected_frames(), 3);
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].image.at<uchar>(0, 0), 10);
  EXPECT_EQ(frames[1].image.at<uchar>(0, 0), 20);
  EXPECT_EQ(frames[2].image.at<uchar>(0, 0), 100);
  EXPECT_EQ(frames[2].index, 2);
  EXPECT_DOUBLE_EQ(frames[2].time_s, 0.2);
  EXPECT_THAT(source->warnings(), IsEmpty());
  const auto faster = read_all(*vo::open_frame_source(folder.path().string(), {.frame_rate_hz = 20}));
  EXPECT_DOUBLE_EQ(faster[2].time_s, 0.1);
}

TEST(FolderSource, HiddenFilesAreNotTheUsers) {
  const TemporaryFolder folder;
  write_image(folder / "1.png", 10);
  write_image(folder / "2.png", 20);
  folder.write("._1.png", "a Macintosh's notes on 1.png");
  folder.write(".thumb.jpg", "");
  EXPECT_EQ(read_all(*vo::open_frame_source(folder.path().string())).size(), 2U);
}

TEST(FolderSource, NamesTheImageThatDoesNotFit) {
  const TemporaryFolder folder;
  write_image(folder / "1.png", 1);
  write_image(folder / "2.png", 1, {9, 4});
  auto source = vo::open_frame_source(folder.path().string());
  source->next();
  EXPECT_THROW_WITH(source->next(), vo::Error, "2.png: is 9x4 pixels; expected 8x4 as 1.png");
}

TEST(FolderSource, OneBrokenImageAmongManyIsLeftOut) {
  const TemporaryFolder folder;
  for (int i = 1; i <= 20; ++i) write_image(folder / fmt::format("{}.png", i), 10 * i);
  folder.write("1.png", "no png");
  folder.write("7.png", "");
  const auto source = vo::open_frame_source(folder.path().string(), {.frame_rate_hz = 10});
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 18U);
  EXPECT_EQ(frames[0].image.at<uchar>(0, 0), 20);
  EXPECT_EQ(frames[0].time_s, 0);
  EXPECT_EQ(frames[5].index, 5);
  EXPECT_DOUBLE_EQ(frames[5].time_s, 0.6);  // 8.png: the time of the one before it passes
  EXPECT_THAT(source->warnings(), ElementsAre(HasSubstr("2 of 20 images cannot be read and are left out, the "
                                                        "first: 1.png")));
}

TEST(FolderSource, ManyBrokenImagesAreRefused) {
  const TemporaryFolder folder;
  for (int i = 1; i <= 18; ++i) write_image(folder / fmt::format("{}.png", i), 10 * i);
  folder.write("3.png", "no png");
  EXPECT_EQ(read_all(*vo::open_frame_source(folder.path().string())).size(), 17U);  // 1 of 18
  folder.write("4.png", "no png");
  const auto source = vo::open_frame_source(folder.path().string());
  EXPECT_THROW_WITH(read_all(*source), vo::Error, "3.png: cannot be read as an image");  // 2 of 18
}

TEST(FolderSource, DeepImagesAreStretchedByTheWalksRange) {
  const TemporaryFolder folder;
  for (int i = 0; i < 5; ++i) {
    cv::Mat image(4, 8, CV_16UC1, cv::Scalar(3000 + 100 * i));
    ASSERT_TRUE(cv::imwrite((folder / fmt::format("{}.png", i)).string(), image));
  }
  const auto source = vo::open_frame_source(folder.path().string());
  const auto frames = read_all(*source);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(frames[i].image.type(), CV_8UC1);
    EXPECT_NEAR(frames[i].image.at<uchar>(0, 0), 255.0 * static_cast<double>(i) / 4, 1);  // rounded
  }
  EXPECT_THAT(source->warnings(), ElementsAre(HasSubstr("3000 is taken for black and 3400 for white")));
}

}  // namespace
