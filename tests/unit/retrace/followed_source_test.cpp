#include "followed_source.hpp"

#include "support/temporary_folder.hpp"

#include <csignal>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using retrace::FollowedSource;
using testing::ElementsAre;

/// Three frames; then what a test wants.
class ThreeFrames : public vo::FrameSource {
 public:
  explicit ThreeFrames(std::function<void()> then = {}) : then_(std::move(then)) {}

  std::optional<vo::Frame> next() override {
    if (frame_ == 3 && then_) then_();
    if (frame_ == 3) return {};
    return vo::Frame{.index = frame_++, .time_s = 0, .image = {}, .colour = {}};
  }
  [[nodiscard]] std::optional<double> start_utc_s() const override { return 1e9; }
  [[nodiscard]] std::vector<std::string> warnings() const override { return {"two damaged frames"}; }

 private:
  std::function<void()> then_;
  std::int64_t frame_ = 0;
};

std::vector<std::int64_t> frames_of(FollowedSource& source) {
  std::vector<std::int64_t> frames;
  while (const std::optional<vo::Frame> frame = source.next()) frames.push_back(frame->index);
  return frames;
}

TEST(FollowedSource, OfAFileHasEveryFrame) {
  FollowedSource source("walk.mp4", std::make_unique<ThreeFrames>());
  EXPECT_THAT(frames_of(source), ElementsAre(0, 1, 2));
  EXPECT_NO_THROW(source.check_end());
  EXPECT_EQ(source.skipped(), 0);
  EXPECT_THAT(source.warnings(), ElementsAre("two damaged frames"));
  EXPECT_EQ(source.start_utc_s(), 1e9);
}

TEST(FollowedSource, SaysAFailureOnlyAtTheEnd) {
  FollowedSource source("walk.mp4", std::make_unique<ThreeFrames>([] { throw vo::Error("it", "broke"); }));
  EXPECT_THAT(frames_of(source), ElementsAre(0, 1, 2));
  EXPECT_THROW_WITH(source.check_end(), vo::Error, "walk.mp4: it: broke");
  EXPECT_THROW_WITH(source.check_end(), vo::Error, "a source that goes on; what was seen is kept");
}

TEST(FollowedSource, OfACameraSkipsWhatCameMeanwhile) {
  std::promise<void> read, done;
  FollowedSource source("camera:0", std::make_unique<ThreeFrames>([&] {
                          read.set_value();
                          done.get_future().wait();
                        }));
  read.get_future().wait();  // all three have come
  const std::optional<vo::Frame> newest = source.next();
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->index, 2);
  EXPECT_EQ(source.skipped(), 2);
  EXPECT_THAT(source.warnings(), ElementsAre("camera:0: 2 frames were skipped, to keep up"));
  EXPECT_FALSE(source.start_utc_s());
  done.set_value();
  EXPECT_FALSE(source.next());
}

TEST(FollowedSource, OnlyStandardInputWaitsOfWhatIsLive) {
  FollowedSource input("-", std::make_unique<ThreeFrames>());
  EXPECT_THAT(frames_of(input), ElementsAre(0, 1, 2));
  EXPECT_NO_THROW(input.check_end());
  for (const char* const stream : {"rtsp://camera/1", "rtsps://camera/1"}) {
    FollowedSource source(stream, std::make_unique<ThreeFrames>());
    frames_of(source);
    EXPECT_THROW_WITH(source.check_end(), vo::Error,
                      std::string(stream) + ": sent no picture more: it ended");
  }
}

TEST(FollowedSource, EndsWhereACameraHangs) {
  std::promise<void> done;
  FollowedSource source("camera:0", std::make_unique<ThreeFrames>([&] { done.get_future().wait(); }), 0.01);
  while (source.next()) {
  }
  EXPECT_THROW_WITH(source.check_end(), vo::Error, "camera:0: sent no picture for 0.01 s");
  EXPECT_THROW_WITH(source.check_end(), vo::Error, "a camera that goes on; what was seen is kept");
  done.set_value();
}

TEST(FollowedSource, EndsWithASignalAndNoFailure) {
  const auto interrupted = [] {
    retrace::end_on_signals();
    FollowedSource source("walk.mp4", std::make_unique<ThreeFrames>());
    const bool before = source.next().has_value();
    std::raise(SIGINT);
    const bool after = source.next().has_value();
    source.check_end();
    ::_exit(before && !after ? 0 : 1);
  };
  EXPECT_EXIT(interrupted(), testing::ExitedWithCode(0), "");
}

}  // namespace
