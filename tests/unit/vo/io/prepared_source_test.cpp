#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>

namespace {

using test_support::corner_picture;
using test_support::TemporaryFolder;
using test_support::write_video;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Read {
  vo::Frame first;
  std::vector<std::string> warnings;
};

Read read(const std::filesystem::path& path, const vo::FrameSourceOptions& options = {}) {
  const auto source = vo::open_frame_source(path.string(), options);
  Read result{.first = source->next().value()};
  result.warnings = source->warnings();
  return result;
}

TEST(PreparedSource, LeavesBlackBarsOut) {
  const TemporaryFolder folder;
  {
    test_support::VideoWriter writer(folder / "walk.mp4", {160, 120});
    cv::Mat letterbox;
    cv::copyMakeBorder(corner_picture({160, 90}), letterbox, 16, 14, 0, 0, cv::BORDER_CONSTANT,
                       cv::Scalar(0));
    for (int i = 0; i < 40; ++i) writer.write(letterbox, i / 25.0);
  }
  const Read walk = read(folder / "walk.mp4", {.colour_width_px = 80});
  EXPECT_EQ(walk.first.image.size(), cv::Size(160, 90));
  EXPECT_NEAR(walk.first.image.at<std::uint8_t>(5, 5), 250, 6);  // mpeg4's loss
  EXPECT_EQ(walk.first.colour.cols, 80);
  EXPECT_NEAR(walk.first.colour.rows, 45, 1);
  EXPECT_THAT(walk.warnings,
              ElementsAre(HasSubstr("has black bars; of its pictures the part 0,16,160,90 is used")));
  EXPECT_EQ(read(folder / "walk.mp4", {.look_ahead = false}).first.image.size(), cv::Size(160, 120));
  EXPECT_EQ(read(folder / "walk.mp4", {.crop = cv::Rect(0, 0, 160, 120)}).first.image.size(),
            cv::Size(160, 120));
}

TEST(PreparedSource, CropsWhereItIsTold) {
  const TemporaryFolder folder;
  write_video(folder / "walk.mp4", 2, {}, corner_picture({64, 48}));
  const Read walk = read(folder / "walk.mp4", {.colour_width_px = 64, .crop = cv::Rect(8, 4, 40, 30)});
  EXPECT_EQ(walk.first.image.size(), cv::Size(40, 30));
  EXPECT_TRUE(walk.first.image.isContinuous());
  EXPECT_EQ(walk.first.colour.size(), cv::Size(40, 30));
  EXPECT_NEAR(walk.first.image.at<std::uint8_t>(1, 1), 250,
              6);  // 8 of 16 columns of the white corner are left
  EXPECT_THAT(walk.warnings, IsEmpty());
  EXPECT_THROW_WITH(read(folder / "walk.mp4", {.crop = cv::Rect(30, 0, 40, 30)}), vo::Error,
                    "walk.mp4: has pictures of 64x48 pixels; expected --crop within them, not 30,0,40,30");
  EXPECT_THROW(read(folder / "walk.mp4", {.crop = cv::Rect(0, 0, 0, 0)}), vo::Error);
}

TEST(PreparedSource, MasksWhatIsNotTheScene) {
  const TemporaryFolder folder;
  cv::Mat picture(48, 64, CV_8UC1, cv::Scalar(100));
  picture(cv::Rect(4, 4, 20, 8)).setTo(255);  // a clock drawn over the picture
  write_video(folder / "walk.mp4", 2, {}, picture);
  cv::Mat mask(48, 64, CV_8UC1, cv::Scalar(255));
  mask(cv::Rect(2, 2, 24, 12)).setTo(0);
  const std::string file = (folder / "mask.png").string();
  cv::imwrite(file, mask);
  const cv::Mat filled = read(folder / "walk.mp4", {.mask = file}).first.image;
  EXPECT_NEAR(filled.at<std::uint8_t>(8, 12), 100, 8);  // mpeg4 rings about the clock
  // Of another size and the same shape, and together with a crop.
  cv::resize(mask, mask, {128, 96}, 0, 0, cv::INTER_NEAREST);
  cv::imwrite(file, mask);
  const cv::Mat part = read(folder / "walk.mp4", {.crop = cv::Rect(4, 4, 30, 30), .mask = file}).first.image;
  EXPECT_EQ(part.size(), cv::Size(30, 30));
  EXPECT_NEAR(part.at<std::uint8_t>(4, 8), 100, 8);

  EXPECT_THROW_WITH(read(folder / "walk.mp4", {.mask = "none.png"}), vo::Error, "none.png: cannot be read");
  cv::imwrite(file, cv::Mat(48, 48, CV_8UC1, cv::Scalar(255)));
  EXPECT_THROW_WITH(read(folder / "walk.mp4", {.mask = file}), vo::Error,
                    "mask.png: is 48x48 pixels; expected the shape of the recording's pictures, 64x48");
  cv::imwrite(file, cv::Mat(48, 64, CV_8UC1, cv::Scalar(0)));
  EXPECT_THROW_WITH(read(folder / "walk.mp4", {.mask = file}), vo::Error, "mask.png: is black all over");
}

}  // namespace
