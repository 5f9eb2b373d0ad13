#include "survey_files.hpp"

#include "support/gpmf_pieces.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using test_support::gps5_piece;
using test_support::TemporaryFolder;

TEST(SurveyFiles, TheTrackMayBeInTheWalksOwnVideo) {
  const TemporaryFolder folder;
  constexpr double kNorth_deg = 1e-4;  // 11.1 m
  test_support::write_video(
      folder / "GX01.MP4", 50,
      {.telemetry = {gps5_piece({{51.5, -0.25}}), gps5_piece({{51.5 + kNorth_deg, -0.25}})}});
  vo::Walk walk;
  walk.source = (folder / "GX01.MP4").string();
  walk.time_s = {0, 0.5, 1};
  place::Route route;
  retrace::SurveyFiles files;
  files.track = "video";
  const std::optional<place::Survey> survey = retrace::read_survey(files, {}, walk, route);
  ASSERT_TRUE(survey);
  ASSERT_EQ(survey->pose.size(), 3U);
  ASSERT_TRUE(survey->pose[0] && survey->pose[1] && survey->pose[2]);
  EXPECT_NEAR(survey->pose[1]->y_m, 11.13 / 2, 0.05);  // a degree of latitude is 111.25 km here
  EXPECT_NEAR(survey->pose[2]->y_m, 11.13, 0.05);
  EXPECT_NEAR(survey->pose[2]->x_m, 0, 0.01);
  ASSERT_TRUE(route.origin);
  EXPECT_NEAR(route.origin->latitude_deg, 51.5, 1e-7);
}

TEST(SurveyFiles, SeveralFilesHaveNoTrackOfTheirOwn) {
  vo::Walk walk;
  walk.source = "GX01.MP4, GX02.MP4";
  walk.time_s = {0, 1};
  place::Route route;
  retrace::SurveyFiles files;
  files.track = "video";
  EXPECT_THROW_WITH(retrace::read_survey(files, {}, walk, route), vo::Error,
                    "--track video: is given for GX01.MP4, GX02.MP4; expected a walk of one video file");
}

}  // namespace
