#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vo/base/rng.hpp>
#include <vo/image/black_bars.hpp>

namespace {

/// A scene that differs from picture to picture, its darkest parts black.
std::vector<cv::Mat> scene(cv::Size size, int brightest = 255) {
  vo::Rng rng(3);
  std::vector<cv::Mat> pictures;
  for (int i = 0; i < 8; ++i) {
    cv::Mat coarse(6, 8, CV_8UC1), picture;
    for (auto value = coarse.begin<std::uint8_t>(); value != coarse.end<std::uint8_t>(); ++value)
      *value = static_cast<std::uint8_t>(rng.index(static_cast<std::uint64_t>(brightest)));
    cv::resize(coarse, picture, size, 0, 0, cv::INTER_LINEAR);
    pictures.push_back(picture);
  }
  return pictures;
}

/// The same with bars of a dark grey, and noise of so many levels all over.
std::vector<cv::Mat> grey_barred(std::vector<cv::Mat> pictures, int rows, int columns, int level,
                                 double noise) {
  vo::Rng rng(4);
  for (cv::Mat& picture : pictures) {
    cv::copyMakeBorder(picture, picture, rows, rows, columns, columns, cv::BORDER_CONSTANT,
                       cv::Scalar(level));
    for (auto value = picture.begin<std::uint8_t>(); value != picture.end<std::uint8_t>(); ++value)
      *value = cv::saturate_cast<std::uint8_t>(*value + noise * rng.normal());
  }
  return pictures;
}

/// The same with bars, which compression makes a little brighter than black.
std::vector<cv::Mat> barred(std::vector<cv::Mat> pictures, int top, int bottom, int left, int right) {
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    cv::copyMakeBorder(pictures[i], pictures[i], top, bottom, left, right, cv::BORDER_CONSTANT,
                       cv::Scalar(static_cast<double>(i % 5)));
  }
  return pictures;
}

TEST(BlackBars, AreFoundOnAnySide) {
  const cv::Size size(160, 90);
  EXPECT_EQ(vo::find_black_bars(barred(scene(size), 15, 15, 0, 0)), cv::Rect(0, 15, 160, 90));
  EXPECT_EQ(vo::find_black_bars(barred(scene(size), 0, 0, 40, 40)), cv::Rect(40, 0, 160, 90));
  EXPECT_EQ(vo::find_black_bars(barred(scene(size), 10, 20, 30, 0)), cv::Rect(30, 10, 160, 90));
  EXPECT_TRUE(vo::may_have_black_bars(barred(scene(size), 0, 8, 0, 0)[0]));
  EXPECT_TRUE(vo::may_have_black_bars(barred(scene(size), 0, 0, 0, 8)[0]));
}

TEST(BlackBars, MayBeDarkGreyAndNoisy) {
  const cv::Size size(320, 180);
  for (const int level : {0, 16, 30, 45}) {
    for (const double noise : {0.0, 2.0, 5.0}) {
      const auto above = grey_barred(scene(size), 30, 0, level, noise);
      EXPECT_TRUE(vo::may_have_black_bars(above[0])) << level << " " << noise;
      EXPECT_EQ(vo::find_black_bars(above), cv::Rect(0, 30, 320, 180)) << level << " " << noise;
      EXPECT_EQ(vo::find_black_bars(grey_barred(scene(size), 0, 60, level, noise)), cv::Rect(60, 0, 320, 180))
          << level << " " << noise;
    }
  }
  // Brighter than that, it may be a wall or a sky.
  EXPECT_FALSE(vo::find_black_bars(grey_barred(scene(size), 30, 0, 60, 2)));
}

TEST(BlackBars, ADarkRoadOrSkyIsNone) {
  // Dark grey below and above, and as even as a bar, but it ends elsewhere in every picture.
  std::vector<cv::Mat> pictures = scene({320, 180});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int swing = 9 * static_cast<int>(i);
    pictures[i].rowRange(0, 20 + swing).setTo(30);
    pictures[i].rowRange(179 - swing, 180).setTo(30);
  }
  EXPECT_FALSE(vo::find_black_bars(grey_barred(pictures, 0, 0, 0, 3)));
}

TEST(BlackBars, AreNotFoundWhereThereAreNone) {
  EXPECT_FALSE(vo::find_black_bars(scene({160, 90})));
  EXPECT_FALSE(vo::find_black_bars({}));
  EXPECT_FALSE(vo::may_have_black_bars(cv::Mat(90, 160, CV_8UC1, cv::Scalar(99))));
  // One row that encoders add is no bar; a picture black all over, and a walk that is, say nothing.
  EXPECT_FALSE(vo::find_black_bars(barred(scene({160, 90}), 1, 0, 0, 0)));
  EXPECT_FALSE(vo::find_black_bars(std::vector<cv::Mat>{cv::Mat(90, 160, CV_8UC1, cv::Scalar(0))}));
  EXPECT_FALSE(vo::find_black_bars(std::vector<cv::Mat>{cv::Mat(1, 1, CV_8UC1, cv::Scalar(0))}));
}

TEST(BlackBars, ANightSkyIsNone) {
  // Black down to roofs of all heights, lit windows below.
  std::vector<cv::Mat> pictures;
  for (int i = 0; i < 8; ++i) {
    cv::Mat picture(90, 160, CV_8UC1, cv::Scalar(3));
    for (int house = 0; house < 8; ++house) {
      const int roof = 20 + (house * 37 + i * 11) % 40;
      picture(cv::Rect(20 * house, roof, 20, 90 - roof)).setTo(cv::Scalar(60));
    }
    pictures.push_back(picture);
  }
  EXPECT_FALSE(vo::find_black_bars(pictures));
}

TEST(BlackBars, HalfABlackPictureIsNone) {
  cv::Mat picture(48, 64, CV_8UC1, cv::Scalar(0));
  picture.colRange(32, 64).setTo(255);
  EXPECT_FALSE(vo::find_black_bars(std::vector<cv::Mat>{picture, picture}));
}

TEST(BlackBars, WhereOneSideIsDarkTheOtherSaysHowFar) {
  // A night sky above, under the bar: it ends nowhere; the one below does.
  std::vector<cv::Mat> pictures = scene({160, 90});
  for (cv::Mat& picture : pictures) {
    for (int house = 0; house < 8; ++house) picture(cv::Rect(20 * house, 0, 20, 6 * (house + 1))).setTo(2);
  }
  EXPECT_EQ(vo::find_black_bars(barred(pictures, 15, 15, 0, 0)), cv::Rect(0, 15, 160, 90));
}

TEST(BlackBars, BlackPicturesAmongOthersDoNotMatter) {
  std::vector<cv::Mat> pictures = barred(scene({160, 90}), 15, 15, 0, 0);
  pictures.insert(pictures.begin(), cv::Mat(120, 160, CV_8UC1, cv::Scalar(0)));
  EXPECT_EQ(vo::find_black_bars(pictures), cv::Rect(0, 15, 160, 90));
}

TEST(BlackBars, DarkScenesKeepTheirs) {
  EXPECT_EQ(vo::find_black_bars(barred(scene({160, 90}, 90), 15, 15, 0, 0)), cv::Rect(0, 15, 160, 90));
}

}  // namespace
