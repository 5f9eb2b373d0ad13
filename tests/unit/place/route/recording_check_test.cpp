#include "place/route/recording_check.hpp"

#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <vo/base/error.hpp>

namespace place {
namespace {

using ::testing::HasSubstr;

/// A walk on foot with nothing wrong.
RecordingFacts good_facts() {
  return {.frames = 1500,
          .duration_s = 60,
          .width_px = 640,
          .height_px = 360,
          .frame_rate_hz = 25,
          .level = 120,
          .blur = 0.3,
          .steps = 100,
          .steps_hz = 1.9,
          .walking_share = 0.9,
          .standing_share = 0.1,
          .common_view_s = 0.2,
          .keyframes = 108,
          .why_no_keyframes = {},
          .steps_spacing_m = 0.85,
          .warnings = {}};
}

Finding found(const RecordingFacts& facts, const std::string& check) {
  const std::vector<Finding> findings = judge_recording(facts);
  const auto it = std::ranges::find(findings, check, &Finding::check);
  return it == findings.end() ? Finding{"none", Fitness::kGood, {}, {}} : *it;
}

TEST(JudgeRecording, AGoodWalkIsFit) {
  const std::vector<Finding> findings = judge_recording(good_facts());
  EXPECT_EQ(findings.size(), 7U);
  EXPECT_EQ(worst(findings), Fitness::kGood);
  EXPECT_THAT(found(good_facts(), "gait").help, HasSubstr("--motion steps"));
  // 60 s, a tenth of it standing: 54 s for 108 keyframes.
  EXPECT_THAT(found(good_facts(), "keyframes").text, HasSubstr("one each 0.50 s of walking; 0.85 m apart"));
}

/// One change to a good walk, the check that must see it, how bad it is, and a part of what is said.
struct Fault {
  const char* name;
  void (*make)(RecordingFacts&);
  const char* check;
  Fitness fitness;
  const char* says;
};

class JudgeRecordingFault : public testing::TestWithParam<Fault> {};

TEST_P(JudgeRecordingFault, IsFoundByItsCheckAlone) {
  const Fault& fault = GetParam();
  RecordingFacts facts = good_facts();
  fault.make(facts);
  const Finding finding = found(facts, fault.check);
  EXPECT_EQ(finding.fitness, fault.fitness);
  EXPECT_THAT(finding.text + " " + finding.help, HasSubstr(fault.says));
  for (const Finding& other : judge_recording(facts)) {
    if (other.check != fault.check) {
      EXPECT_EQ(other.fitness, Fitness::kGood) << other.check;
    }
  }
  EXPECT_EQ(worst(judge_recording(facts)), fault.fitness);
}

INSTANTIATE_TEST_SUITE_P(
    , JudgeRecordingFault,
    testing::Values(
        Fault{"slow", [](RecordingFacts& f) { f.frame_rate_hz = 8; }, "frame rate", Fitness::kWithCare,
              "more than 8"},
        Fault{"dark", [](RecordingFacts& f) { f.level = 39; }, "light", Fitness::kWithCare, "by day"},
        Fault{"black", [](RecordingFacts& f) { f.level = 7; }, "light", Fitness::kUnfit, "black"},
        Fault{"blurred", [](RecordingFacts& f) { f.blur = 0.5; }, "blur", Fitness::kWithCare, "lens"},
        Fault{"one_colour", [](RecordingFacts& f) { f.blur.reset(); }, "blur", Fitness::kUnfit, "one colour"},
        Fault{"no_steps", [](RecordingFacts& f) { f.steps = 0; }, "gait", Fitness::kWithCare,
              "--motion none"},
        Fault{"few_steps", [](RecordingFacts& f) { f.walking_share = 0.4; }, "gait", Fitness::kWithCare,
              "--motion sad"},
        Fault{"alike", [](RecordingFacts& f) { f.common_view_s = 0; }, "overlap", Fitness::kUnfit,
              "no motion"},
        Fault{"apart", [](RecordingFacts& f) { f.common_view_s = 0.1; }, "overlap", Fitness::kWithCare,
              "0.10 s apart"},
        Fault{"short", [](RecordingFacts& f) { f.keyframes = 14; }, "keyframes", Fitness::kWithCare, "short"},
        Fault{"none",
              [](RecordingFacts& f) {
                f.keyframes = 0;
                f.why_no_keyframes = "shows no motion";
              },
              "keyframes", Fitness::kUnfit, "shows no motion"},
        Fault{"warned", [](RecordingFacts& f) { f.warnings = {"breaks off"}; }, "recording",
              Fitness::kWithCare, "breaks off"}),
    [](const testing::TestParamInfo<Fault>& fault) { return fault.param.name; });

TEST(JudgeRecording, PausesAreToldByTheirShare) {
  RecordingFacts facts = good_facts();
  facts.standing_share = 0.6;
  facts.walking_share = 0.4;  // all the rest of the time
  EXPECT_EQ(found(facts, "pauses").fitness, Fitness::kWithCare);
  EXPECT_EQ(found(facts, "gait").fitness, Fitness::kGood);
  facts.standing_share = 1;
  EXPECT_EQ(found(facts, "pauses").fitness, Fitness::kUnfit);
  EXPECT_EQ(worst({}), Fitness::kGood);
}

TEST(ExamineRecording, MeasuresWhatWasRecorded) {
  const test_support::TemporaryFolder folder;
  const std::string noise = (folder.path() / "noise.mp4").string();
  test_support::write_moving_noise(noise);  // 70 frames of 160x128 at 25 Hz, each value as likely
  const RecordingFacts facts = examine_recording(std::vector{noise}, {});
  EXPECT_EQ(facts.frames, 70U);
  EXPECT_NEAR(facts.duration_s, 69 / 25.0, 1e-6);
  EXPECT_NEAR(facts.frame_rate_hz, 25, 1e-6);
  EXPECT_EQ(facts.width_px, 160);
  EXPECT_NEAR(facts.level, 127.5, 3);  // clipped by coding
  ASSERT_TRUE(facts.blur);
  EXPECT_LT(*facts.blur, 0.25);  // independent pixels lose about eight ninths
  EXPECT_EQ(facts.steps, 0U);
  EXPECT_NEAR(facts.standing_share, 0, 1e-9);
  EXPECT_NEAR(facts.steps_spacing_m, 0.85, 1e-9);
}

TEST(ExamineRecording, OfAStillCameraThereIsNoWalk) {
  const test_support::TemporaryFolder folder;
  for (int i = 0; i < 60; ++i) {
    cv::Mat picture(60, 80, CV_8UC3, cv::Scalar(30, 60, 90));
    cv::imwrite((folder.path() / (std::to_string(i) + ".png")).string(), picture);
  }
  const RecordingFacts facts = examine_recording(std::vector{folder.path().string()}, {});
  EXPECT_NEAR(facts.level, 0.114 * 30 + 0.587 * 60 + 0.299 * 90, 1);  // grey of a colour, whole levels
  EXPECT_FALSE(facts.blur);
  EXPECT_DOUBLE_EQ(facts.standing_share, 1);
  EXPECT_EQ(facts.keyframes, 0U);
  EXPECT_THAT(facts.why_no_keyframes, HasSubstr("no motion"));
  EXPECT_EQ(worst(judge_recording(facts)), Fitness::kUnfit);
  EXPECT_THROW(examine_recording(std::vector<std::string>{"none.mp4"}, {}), vo::Error);
}

}  // namespace
}  // namespace place
