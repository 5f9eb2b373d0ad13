#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>

namespace {

using test_support::TemporaryFolder;
using test_support::write_video;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ChainedSource : public testing::Test {
 protected:
  /// A chapter of a second and a half at 20 frames/s.
  std::string chapter(const std::string& name, const char* creation_time = nullptr) {
    test_support::VideoOptions options{.rate_hz = 20};
    if (creation_time != nullptr) options.tags["creation_time"] = creation_time;
    write_video(folder_ / name, 30, options);
    return (folder_ / name).string();
  }

  /// All times, and what is warned of.
  std::vector<double> times(const std::vector<std::string>& walks) {
    const auto source = vo::open_frame_source(walks);
    std::vector<double> all;
    while (const auto frame = source->next()) {
      EXPECT_EQ(frame->index, static_cast<std::int64_t>(all.size()));
      all.push_back(frame->time_s);
    }
    EXPECT_EQ(source->expected_frames(), static_cast<std::int64_t>(all.size()));
    warnings_ = source->warnings();
    start_utc_s_ = source->start_utc_s();
    return all;
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
  std::optional<double> start_utc_s_;
};

TEST_F(ChainedSource, ChaptersOfOneRecordingFollowAtOnce) {
  // All of them say when the recording began.
  const auto all =
      times({chapter("W1.mp4", "2001-09-09T01:46:40Z"), chapter("W2.mp4", "2001-09-09T01:46:40Z"),
             chapter("W3.mp4", "2001-09-09T01:46:40Z")});
  ASSERT_EQ(all.size(), 90U);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_NEAR(all[i], static_cast<double>(i) / 20, 2e-3);  // milliseconds, of three files
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_EQ(start_utc_s_, 1e9);
  // Each says its own: the second begins as the first ends, to the second.
  EXPECT_NEAR(
      times({chapter("W1.mp4", "2001-09-09T01:46:40Z"), chapter("W2.mp4", "2001-09-09T01:46:41Z")})[30], 1.5,
      2e-3);
}

TEST_F(ChainedSource, APauseIsAsLongAsTheirTimesSay) {
  const auto all =
      times({chapter("W1.mp4", "2001-09-09T01:46:40Z"), chapter("W2.mp4", "2001-09-09T01:48:20Z")});
  EXPECT_NEAR(all[30], 100, 2e-3);
  EXPECT_THAT(warnings_,
              ElementsAre(HasSubstr("W2.mp4: begins 98 s after ")));  // 100 less 1.5, rounded to even
}

TEST_F(ChainedSource, AnUnknownPauseIsSaid) {
  const auto all = times({chapter("W1.mp4"), chapter("W2.mp4")});
  EXPECT_NEAR(all[30], 1.5 + vo::kUnknownPause_s, 2e-3);
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("W2.mp4: does not say how long after ")));
  // Days later: their clocks say nothing of one walk. The second before the first: perhaps the wrong way
  // round.
  times({chapter("W1.mp4", "2001-09-09T01:46:40Z"), chapter("W2.mp4", "2001-09-09T01:00:00Z")});
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("W2.mp4: was recorded before ")));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("are they in order?")));
  times({chapter("W1.mp4", "2001-09-09T01:46:40Z"), chapter("W2.mp4", "2001-09-12T01:00:00Z")});
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("does not say")));
}

TEST_F(ChainedSource, RefusesWhatDoesNotFit) {
  const std::string first = chapter("W1.mp4");
  write_video(folder_ / "small.mp4", 3, {}, test_support::corner_picture({32, 32}));
  EXPECT_THROW_WITH(times({first, (folder_ / "small.mp4").string()}), vo::Error,
                    "small.mp4: has pictures of 32x32 pixels; expected 64x48 as ");
  EXPECT_THROW_WITH(times({first, (folder_ / "none.mp4").string()}), vo::Error, "none.mp4: does not exist");
  EXPECT_THROW_WITH(times({first, "camera:0"}), vo::Error, "camera:0: cannot be one of several");
  EXPECT_THROW(vo::open_frame_source(std::vector<std::string>()), std::invalid_argument);
  EXPECT_EQ(times({first}).size(), 30U);
}

TEST_F(ChainedSource, AChapterOfOneFrameTakesItsTime) {
  test_support::VideoOptions one{.rate_hz = 20};
  one.tags["creation_time"] = "2001-09-09T01:46:40Z";
  write_video(folder_ / "W1.mp4", 1, one);
  const auto all = times({(folder_ / "W1.mp4").string(), chapter("W2.mp4", "2001-09-09T01:46:40Z")});
  ASSERT_EQ(all.size(), 31U);
  EXPECT_GT(all[1], all[0]);
  EXPECT_NEAR(all[2] - all[1], 0.05, 2e-3);
}

}  // namespace
