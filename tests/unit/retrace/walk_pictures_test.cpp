#include "walk_pictures.hpp"

#include "support/temporary_folder.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

using test_support::TemporaryFolder;

constexpr int kFrames = 150;

/// A folder of pictures, each of the grey level of its number.
std::string made_walk(const TemporaryFolder& folder) {
  const auto walk = folder.path() / "walk";
  std::filesystem::create_directory(walk);
  for (int i = 0; i < kFrames; ++i)
    cv::imwrite((walk / (std::to_string(i) + ".png")).string(), cv::Mat(24, 64, CV_8UC1, cv::Scalar(i)));
  return walk.string();
}

int level_of(const WalkPicture& picture) {
  return picture.image.at<cv::Vec3b>(5, 5)[1];
}

TEST(WalkPictures, GivesAnyFrameForwardsAndBackwards) {
  const TemporaryFolder folder;
  const auto pictures = recorded_pictures({{made_walk(folder)}, {}, kFrames}, 32);
  for (const int frame : {0, 3, 3, 2, 100, 90, 40, 37, 0, 149, 148, 10}) {
    const WalkPicture picture = pictures->at(frame);
    EXPECT_EQ(level_of(picture), frame);
    EXPECT_NEAR(picture.time_s, frame / vo::kImageRate_hz, 1e-9);
    EXPECT_EQ(picture.image.size(), cv::Size(32, 12));
    EXPECT_EQ(picture.image.type(), CV_8UC3);
  }
}

TEST(WalkPictures, RefusesARecordingOfAnotherLength) {
  const TemporaryFolder folder;
  const std::string walk = made_walk(folder);
  const auto message = [&](std::int64_t frames, std::int64_t at) -> std::string {
    try {
      recorded_pictures({{walk}, {}, frames}, 32)->at(at);
    } catch (const vo::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message(200, 0), testing::HasSubstr("has 150 frames; expected the walk of the run, with 200"));
  EXPECT_THAT(message(152, 151),
              testing::HasSubstr("has 150 frames; expected the walk of the run, with 152"));
  EXPECT_THAT(message(149, 148), testing::HasSubstr("has 150 frames or more"));
  EXPECT_EQ(message(150, 149), "");
  EXPECT_THAT(message(0, 150), testing::HasSubstr("has 150 frames"));  // any length, but it ends
}

TEST(WalkPictures, PreviewsAreThoseOfTheNearestKeyframe) {
  place::Traverse traverse;
  traverse.name = "day";
  for (const int frame : {0, 10, 20}) {
    place::Keyframe keyframe;
    keyframe.frame = frame;
    keyframe.time_s = frame / 10.0;
    cv::imencode(".jpg", cv::Mat(24, 64, CV_8UC1, cv::Scalar(100 + frame)), keyframe.preview_jpeg);
    traverse.keyframes.push_back(std::move(keyframe));
  }
  const auto pictures = preview_pictures(traverse);
  ASSERT_NE(pictures, nullptr);
  for (const auto& [frame, keyframe] : {std::pair(0, 0), {4, 0}, {6, 10}, {14, 10}, {16, 20}, {99, 20}}) {
    EXPECT_NEAR(level_of(pictures->at(frame)), 100 + keyframe, 2) << frame;  // JPEG
    EXPECT_NEAR(pictures->at(frame).time_s, keyframe / 10.0, 1e-9) << frame;
  }
  traverse.keyframes[1].preview_jpeg.clear();
  EXPECT_THROW(pictures->at(11), vo::Error);
  for (place::Keyframe& keyframe : traverse.keyframes) keyframe.preview_jpeg.clear();
  EXPECT_EQ(preview_pictures(traverse), nullptr);
}

}  // namespace
}  // namespace retrace
