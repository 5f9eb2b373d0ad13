#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <cmath>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>

namespace {

using test_support::corner_picture;
using test_support::TemporaryFolder;
using test_support::VideoOptions;
using test_support::VideoWriter;
using test_support::write_video;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<vo::Frame> read_all(vo::FrameSource& source) {
  std::vector<vo::Frame> frames;
  while (auto frame = source.next()) frames.push_back(*frame);
  return frames;
}

/// What a walk's frames and warnings are.
struct Read {
  std::vector<vo::Frame> frames;
  std::vector<std::string> warnings;
  std::optional<double> start_utc_s;
};

Read read(const std::filesystem::path& path, const vo::FrameSourceOptions& options = {}) {
  const auto source = vo::open_frame_source(path.string(), options);
  Read result{.frames = read_all(*source)};
  result.warnings = source->warnings();
  result.start_utc_s = source->start_utc_s();
  return result;
}

/// The mean of a quarter by a quarter in a corner.
double corner(const cv::Mat& image, bool right, bool below) {
  const int w = image.cols / 4, h = image.rows / 4;
  const cv::Rect part(right ? image.cols - w : 0, below ? image.rows - h : 0, w, h);
  return cv::mean(image(part))[0];
}

constexpr double kLoss = 6;  // grey levels, of mpeg4 at its best on plain areas

TEST(VideoSource, HasTheTimesOfItsContainer) {
  const TemporaryFolder folder;
  {
    VideoWriter writer(folder / "walk.mp4", {64, 48});
    for (const double time_s : {0.0, 0.04, 0.08, 0.5, 0.54, 10.0}) writer.write(corner_picture(), time_s);
  }
  const Read walk = read(folder / "walk.mp4");
  ASSERT_EQ(walk.frames.size(), 6U);
  EXPECT_NEAR(walk.frames[3].time_s, 0.5, 1e-3);  // milliseconds
  EXPECT_NEAR(walk.frames[5].time_s, 10, 1e-3);
  EXPECT_THAT(walk.warnings, IsEmpty());
  EXPECT_FALSE(walk.start_utc_s);
}

TEST(VideoSource, TakesAnotherFrameRateWhereItIsTold) {
  const TemporaryFolder folder;
  write_video(folder / "walk.mp4", 5);
  const Read walk = read(folder / "walk.mp4", {.frame_rate_hz = 100});
  ASSERT_EQ(walk.frames.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(walk.frames[i].time_s, static_cast<double>(i) / 100);
}

TEST(VideoSource, SlowMotionAndTimeLapseHaveTheTimesOfTheRecording) {
  const TemporaryFolder folder;
  write_video(folder / "slow.mp4", 9, {.tags = {{"com.android.capture.fps", "200.000000"}}});
  const Read slow = read(folder / "slow.mp4");
  ASSERT_EQ(slow.frames.size(), 9U);
  EXPECT_NEAR(slow.frames[8].time_s, 8 / 200.0, 1e-6);
  EXPECT_THAT(slow.warnings,
              ElementsAre(HasSubstr("recorded at 200 frames/s, as its tag says, and played at 25")));
  EXPECT_NEAR(read(folder / "slow.mp4", {.frame_rate_hz = 25}).frames[8].time_s, 8 / 25.0, 1e-6);

  write_video(folder / "lapse.mp4", 5, {.tags = {{"com.android.capture.fps", "0.5"}}});
  EXPECT_NEAR(read(folder / "lapse.mp4").frames[4].time_s, 8, 1e-6);

  // Recorded as it plays, as near as a camera keeps its rate; and high frame rates that play at their own.
  write_video(folder / "same.mp4", 5, {.tags = {{"com.android.capture.fps", "24.9"}}});
  EXPECT_NEAR(read(folder / "same.mp4").frames[4].time_s, 4 / 25.0, 1e-3);
  EXPECT_THAT(read(folder / "same.mp4").warnings, IsEmpty());
  write_video(folder / "apple.mov", 5,
              {.tags = {{"com.apple.quicktime.full-frame-rate-playback-intent", "0"}}, .rate_hz = 200});
  EXPECT_NEAR(read(folder / "apple.mov").frames[4].time_s, 4 / 200.0, 1e-3);
}

TEST(VideoSource, SaysWhenItWasRecorded) {
  const TemporaryFolder folder;
  const auto start = [&](std::map<std::string, std::string> tags) {
    write_video(folder / "walk.mp4", 26, {.tags = std::move(tags)});
    return read(folder / "walk.mp4").start_utc_s;
  };
  EXPECT_EQ(start({{"creation_time", "2001-09-09T01:46:40Z"}}), 1e9);
  EXPECT_EQ(start({{"creation_time", "2001-09-09T01:46:50Z"},
                   {"com.apple.quicktime.creationdate", "2001-09-09T03:46:40+0200"}}),
            1e9);
  EXPECT_FALSE(start({{"creation_time", "1970-01-01T00:00:00Z"}}));  // a clock that was never set
  // Android writes it when the recording ends: 26 frames are 1.04 s.
  EXPECT_NEAR(start({{"creation_time", "2001-09-09T01:46:40Z"}, {"com.android.version", "14"}}).value(),
              1e9 - 1.04, 0.05);
  // In true time: these 26 took 0.13 s, or as long as the user says.
  const std::map<std::string, std::string> slow{{"creation_time", "2001-09-09T01:46:40Z"},
                                                {"com.android.version", "14"},
                                                {"com.android.capture.fps", "200"}};
  EXPECT_NEAR(start(slow).value(), 1e9 - 0.13, 0.01);
  EXPECT_NEAR(read(folder / "walk.mp4", {.frame_rate_hz = 100}).start_utc_s.value(), 1e9 - 0.26, 0.02);
}

TEST(VideoSource, OfAPipeIsReadOnce) {
  const TemporaryFolder folder;
  const auto pipe = folder / "walk.y4m";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  // Dark bars above and below, which in a file would be looked for all over it.
  cv::Mat picture = corner_picture();
  picture.rowRange(0, 8).setTo(cv::Scalar::all(0));
  picture.rowRange(40, 48).setTo(cv::Scalar::all(0));
  const std::jthread writer([&] {
    std::ofstream to(pipe, std::ios::binary);
    to << "YUV4MPEG2 W64 H48 F25:1 Ip A1:1 Cmono\n";
    for (int i = 0; i < 20; ++i) {
      to << "FRAME\n";
      to.write(reinterpret_cast<const char*>(picture.data), static_cast<std::streamsize>(picture.total()));
    }
  });
  EXPECT_EQ(read(pipe).frames.size(), 20U);
}

TEST(VideoSource, IsUprightHoweverItWasHeld) {
  const TemporaryFolder folder;
  constexpr std::int32_t k1 = 1 << 16, kW = 1 << 30;
  struct Case {
    const char* what;
    std::array<std::int32_t, 9> matrix;
    cv::Size size;
    bool right, below;  // where the white corner goes
  };
  // x' = m0 x + m3 y, y' = m1 x + m4 y.
  const std::vector<Case> cases{
      {"as it is", {k1, 0, 0, 0, k1, 0, 0, 0, kW}, {64, 48}, false, false},
      {"a quarter turn clockwise", {0, k1, 0, -k1, 0, 0, 0, 0, kW}, {48, 64}, true, false},
      {"upside down", {-k1, 0, 0, 0, -k1, 0, 0, 0, kW}, {64, 48}, true, true},
      {"a quarter turn back", {0, -k1, 0, k1, 0, 0, 0, 0, kW}, {48, 64}, false, true},
      {"mirrored", {-k1, 0, 0, 0, k1, 0, 0, 0, kW}, {64, 48}, true, false},
      {"mirrored upside down", {k1, 0, 0, 0, -k1, 0, 0, 0, kW}, {64, 48}, false, true},
      {"turned and mirrored", {0, k1, 0, k1, 0, 0, 0, 0, kW}, {48, 64}, false, false},
      {"turned back and mirrored", {0, -k1, 0, -k1, 0, 0, 0, 0, kW}, {48, 64}, true, true},
  };
  for (const Case& c : cases) {
    write_video(folder / "walk.mp4", 1, {.display_matrix = c.matrix});
    const vo::Frame frame = read(folder / "walk.mp4", {.colour_width_px = 32}).frames.at(0);
    ASSERT_EQ(frame.image.size(), c.size) << c.what;
    EXPECT_NEAR(corner(frame.image, c.right, c.below), 250, kLoss) << c.what;
    EXPECT_NEAR(corner(frame.colour, c.right, c.below), 250, 2 * kLoss) << c.what;
    EXPECT_EQ(frame.colour.cols < frame.colour.rows, c.size.width < c.size.height) << c.what;
  }
}

TEST(VideoSource, PixelsAreMadeSquare) {
  const TemporaryFolder folder;
  const auto size = [&](AVRational aspect, std::optional<std::array<std::int32_t, 9>> matrix = std::nullopt) {
    write_video(folder / "walk.mp4", 1, {.pixel_aspect = aspect, .display_matrix = matrix});
    return read(folder / "walk.mp4").frames.at(0).image.size();
  };
  EXPECT_EQ(size({4, 3}), cv::Size(85, 48));  // 64 x 4/3
  EXPECT_EQ(size({3, 4}), cv::Size(64, 64));  // 48 x 4/3: nothing is lost
  EXPECT_EQ(size({1, 1}), cv::Size(64, 48));
  EXPECT_EQ(size({200, 199}), cv::Size(64, 48));  // rounded by an encoder
  EXPECT_EQ(size({4, 3}, std::array<std::int32_t, 9>{0, 1 << 16, 0, -(1 << 16), 0, 0, 0, 0, 1 << 30}),
            cv::Size(48, 85));
  write_video(folder / "walk.mp4", 1, {.pixel_aspect = {4, 3}});
  EXPECT_NEAR(corner(read(folder / "walk.mp4").frames.at(0).image, false, false), 250, kLoss);
}

TEST(VideoSource, DeepPicturesAreStretchedByTheWalksRange) {
  const TemporaryFolder folder;
  {
    // A thermal camera: a few hundred values of 65536, another part of them at the end.
    VideoWriter writer(folder / "thermal.mkv", {64, 48}, {.codec = "ffv1"});
    for (int i = 0; i < 40; ++i) {
      cv::Mat picture(48, 64, CV_16UC1);
      for (int x = 0; x < 64; ++x) picture.col(x).setTo(cv::Scalar(7000 + 2 * x + 10 * i));
      writer.write(picture, i / 25.0);
    }
  }
  const Read walk = read(folder / "thermal.mkv");
  ASSERT_EQ(walk.frames.size(), 40U);
  EXPECT_THAT(walk.warnings,
              ElementsAre(HasSubstr("pictures of more than 8 bits: 7000 is taken for black and 74")));
  EXPECT_LE(walk.frames[0].image.at<std::uint8_t>(10, 0), 1);
  EXPECT_GE(walk.frames[39].image.at<std::uint8_t>(10, 63), 250);  // of 32 pictures looked at
  // 126 of about 490 values lie in one picture; the last few are left to hot pixels.
  EXPECT_NEAR(walk.frames[20].image.at<std::uint8_t>(10, 63) - walk.frames[20].image.at<std::uint8_t>(10, 0),
              62, 4);
  const Read live = read(folder / "thermal.mkv", {.look_ahead = false});
  EXPECT_GE(live.frames[0].image.at<std::uint8_t>(10, 63), 254);  // by the first picture alone
}

TEST(VideoSource, LongerSoundIsNoBreak) {
  const TemporaryFolder folder;
  write_video(folder / "walk.mov", 25, {.sound_s = 10});
  const Read walk = read(folder / "walk.mov");
  EXPECT_EQ(walk.frames.size(), 25U);
  EXPECT_THAT(walk.warnings, IsEmpty());
}

TEST(VideoSource, PicturesThatAnEditListHidesAreNotMissing) {
  const TemporaryFolder folder;
  {
    VideoWriter writer(folder / "cut.mp4", {64, 48});
    for (int i = -30; i < 30; ++i) writer.write(corner_picture(), i / 25.0);  // what is before 0 is not shown
  }
  const Read walk = read(folder / "cut.mp4");
  EXPECT_GE(walk.frames.size(), 30U);
  EXPECT_THAT(walk.warnings, IsEmpty());
}

TEST(VideoSource, AVariableRateIsNoBreak) {
  const TemporaryFolder folder;
  {
    VideoWriter writer(folder / "screen.mp4", {64, 48}, {.rate_hz = 60});
    double time_s = 0;
    for (int i = 0; i < 20; ++i) writer.write(corner_picture(), time_s += 0.1 * (1 + i % 5));
  }
  EXPECT_THAT(read(folder / "screen.mp4").warnings, IsEmpty());
}

TEST(VideoSource, SaysThatItBreaksOff) {
  const TemporaryFolder folder;
  write_video(folder / "whole.mkv", 40, {.codec = "ffv1"});
  const std::string whole = test_support::read_file(folder / "whole.mkv");
  folder.write("cut.mkv", whole.substr(0, whole.size() / 2));
  const Read walk = read(folder / "cut.mkv");
  EXPECT_GT(walk.frames.size(), 5U);
  EXPECT_LT(walk.frames.size(), 38U);
  EXPECT_THAT(walk.warnings, testing::Contains(HasSubstr("cut.mkv: breaks off: ")));
}

TEST(VideoSource, ReadsY4mOnStandardInput) {
  const TemporaryFolder folder;
  std::string y4m = "YUV4MPEG2 W4 H2 F20:1 Ip A1:1 C420\n";
  for (int i = 0; i < 3; ++i)
    y4m += "FRAME\n" + std::string(8, static_cast<char>(16 + 73 * i)) + std::string(4, '\x80');
  const auto path = folder.write("walk.y4m", y4m);
  const int saved = ::dup(STDIN_FILENO);
  ASSERT_NE(std::freopen(path.c_str(), "rb", stdin), nullptr);
  std::vector<vo::Frame> frames;
  std::string refused;
  try {
    frames = read_all(*vo::open_frame_source("-"));
    vo::open_frame_source("-");  // nothing is left
  } catch (const vo::Error& error) {
    refused = error.what();
  }
  ::dup2(saved, STDIN_FILENO);
  ::close(saved);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].image.size(), cv::Size(4, 2));
  EXPECT_EQ(frames[0].image.at<std::uint8_t>(0, 0), 0);
  EXPECT_NEAR(frames[1].image.at<std::uint8_t>(0, 0), 85, 1);  // 73 of 219
  EXPECT_DOUBLE_EQ(frames[2].time_s, 0.1);
  EXPECT_THAT(refused, HasSubstr("standard input: holds no Y4M"));
}

TEST(VideoSource, SaysWhichAddressDoesNotAnswer) {
  EXPECT_THROW_WITH(vo::open_frame_source("rtsp://127.0.0.1:9/walk"), vo::Error,
                    "rtsp://127.0.0.1:9/walk: cannot be opened: ");
}

TEST(VideoSource, DamageIsCountedAndTheSameEveryTime) {
  const TemporaryFolder folder;
  test_support::write_moving_noise(folder / "whole.mp4");
  EXPECT_THAT(read(folder / "whole.mp4").warnings, IsEmpty());
  const auto path =
      folder.write("damaged.mp4", test_support::damaged(test_support::read_file(folder / "whole.mp4"), 1));
  const Read first = read(path), second = read(path);
  ASSERT_FALSE(first.warnings.empty());
  EXPECT_THAT(first.warnings[0], HasSubstr(" damaged frames, the first at "));
  EXPECT_EQ(first.warnings, second.warnings);
  ASSERT_EQ(first.frames.size(), second.frames.size());
  for (std::size_t i = 0; i < first.frames.size(); ++i)
    EXPECT_EQ(cv::norm(first.frames[i].image, second.frames[i].image, cv::NORM_INF), 0) << i;
}

}  // namespace
