#include "report/run_view.hpp"

#include "report/path_charts.hpp"
#include "report/run_charts.hpp"
#include "report/run_data.hpp"
#include "report/run_pictures.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using nlohmann::ordered_json;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::IsEmpty;

/// A run of two matches with this report data and summary.
class RunViewTest : public testing::Test {
 protected:
  retrace::RunView view(const std::string& data, const std::string& summary = "{}") {
    folder_.write(
        "matches.csv",
        "query_frame,query_time_s,traverse,reference_frame,score,accepted\n0,0,day,0,1,1\n9,1,day,5,2,0\n");
    folder_.write("report_data.json", data);
    folder_.write("summary.json", summary);
    data_ = retrace::read_run_data(folder_.path());
    return retrace::read_run(folder_.path(), data_, nullptr);
  }

 private:
  TemporaryFolder folder_;
  ordered_json data_;
};

TEST_F(RunViewTest, ReadsTheColumnsOfWalks) {
  const auto run = view(
      R"({"unit": 0.5, "query": {"frame": [0, 9], "time_s": [0, 1], "displacement": [0, 2]},)"
      R"( "traverses": [{"name": "day", "frame": [0, 5], "distance_m": [0, null], "x_m": [1, 2], "y_m": [3, 4]}]})",
      R"({"queries": 2, "query": "a.mp4", "warnings": ["w"]})");
  EXPECT_EQ(run.unit, 0.5);
  EXPECT_THAT(run.query->displacement, ElementsAre(0, 2));
  EXPECT_THAT(run.traverses[0].x_m, ElementsAre(1, 2));
  EXPECT_EQ(run.counts->queries, 2U);
  EXPECT_THAT(run.counts->warnings, ElementsAre("w"));
  EXPECT_FALSE(retrace::straightness_chart(run));  // no times of the traverse's keyframes
}

TEST_F(RunViewTest, LeavesOutWhatIsOfAnotherKindOrLength) {
  const auto run = view(
      R"({"unit": "x", "query": {"frame": [0, -9], "time_s": [0, 1e300], "displacement": [0, 2]},)"
      R"( "traverses": [7, {"name": 7, "frame": [5, 5], "x_m": [1]}, {"frame": [0, 5], "x_m": [1, 2], "y_m": [3]}]})",
      R"({"queries": "two", "query": 2, "warnings": [{}, 1]})");
  EXPECT_EQ(run.unit, 0);
  EXPECT_THAT(run.query->frame, IsEmpty());
  EXPECT_THAT(run.query->time_s, IsEmpty());  // a chart would step through it for ever
  ASSERT_EQ(run.traverses.size(), 3U);
  EXPECT_THAT(run.traverses[1].frame, IsEmpty());
  EXPECT_THAT(run.traverses[2].x_m, IsEmpty());
  EXPECT_EQ(run.counts->queries, 0U);
  EXPECT_THAT(run.counts->warnings, IsEmpty());
  EXPECT_FALSE(retrace::speed_chart(run));
  EXPECT_FALSE(retrace::keyframe_chart(run));
  EXPECT_FALSE(retrace::map_chart(run));
  EXPECT_THAT(retrace::matrix_figures(run), IsEmpty());
}

TEST_F(RunViewTest, ShowsNoPictureFromElsewhere) {
  const auto run = view(
      R"({"traverses": [{"name": "day", "frame": [0, 5], "pictures": {"raw": "http://a/b.png",)"
      R"( "enhanced": "data:image/png;base64,AA=="}}, {"name": "n", "frame": [1], "pictures": {"raw": "file:///c"}}],)"
      R"( "pairs": [{"keyframe": 0, "query": "https://a/b.png", "reference": "data:image/jpeg;base64,AA==", "evil": 1},)"
      R"( {"keyframe": "x"}, {"keyframe": 99}, 5]})");
  const auto figures = retrace::matrix_figures(run);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_THAT(figures[0].json, testing::HasSubstr(R"("pictures":{"enhanced":"data:image/png;base64,AA=="})"));
  const auto strip = ordered_json::parse(retrace::strip_json(run).value());
  ASSERT_EQ(strip["pairs"].size(), 1U);
  EXPECT_FALSE(strip["pairs"][0].contains("query"));
  EXPECT_FALSE(strip["pairs"][0].contains("evil"));
  EXPECT_EQ(strip["pairs"][0]["reference"], "data:image/jpeg;base64,AA==");
}

}  // namespace
