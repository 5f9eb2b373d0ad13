#include "follow_record.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

namespace {

using namespace retrace;
using testing::HasSubstr;
using testing::Not;

place::Position moment(int i, double time_s) {
  return {.frame = i, .time_s = time_s};
}

vo::Frame frame(int width = 40, int height = 20) {
  return {.image = cv::Mat(height, width, CV_8U, cv::Scalar(128)), .colour = {}};
}

/// What the page's player reads.
nlohmann::json spec_of(const std::string& page) {
  const std::string opening = "<script type=\"application/json\">";
  const std::size_t begin = page.find(opening) + opening.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(FollowRecord, KeepsAMomentEveryHalfASecond) {
  FollowRecord record;
  EXPECT_TRUE(record.moments().empty());
  for (int i = 0; i < 100; ++i) record.push(moment(i, 0.125 * i), frame());
  ASSERT_EQ(record.moments().size(), 25U);
  for (std::size_t i = 0; i < 25; ++i)
    EXPECT_EQ(record.moments()[i].position.frame, static_cast<std::int64_t>(4 * i));
}

TEST(FollowRecord, KeepsFewerThanSixHundredEvenlyHoweverLongTheWalk) {
  FollowRecord record;
  constexpr int kFrames = 20000;
  for (int i = 0; i < kFrames; ++i) {
    record.push(moment(i, 0.5 * i), frame(4, 4));
    ASSERT_LT(record.moments().size(), 600U);
  }
  const auto& kept = record.moments();
  EXPECT_GE(kept.size(), 299U);
  EXPECT_EQ(kept.front().position.frame, 0);
  // 0.5 s times 2 for each halving: the 600th of 1, 2, 4, ... frames apart comes at 600, 1200, ..., 19200.
  for (std::size_t i = 1; i < kept.size(); ++i)
    ASSERT_EQ(kept[i].position.frame - kept[i - 1].position.frame, 64) << i;
  EXPECT_GT(kept.back().position.frame, kFrames - 65);
}

TEST(FollowRecord, PicturesAreSmallAndInColourWhereThereAreColours) {
  FollowRecord record;
  vo::Frame coloured = frame(640, 360);
  coloured.colour = cv::Mat(90, 160, CV_8UC3, cv::Scalar(0, 0, 200));
  record.push(moment(0, 0), coloured);
  record.push(moment(1, 1), frame(640, 360));
  const cv::Mat red = cv::imdecode(record.moments()[0].jpeg, cv::IMREAD_COLOR);
  EXPECT_EQ(red.size(), cv::Size(160, 90));
  EXPECT_NEAR(red.at<cv::Vec3b>(45, 80)[2], 200, 8);  // of JPEG
  EXPECT_NEAR(red.at<cv::Vec3b>(45, 80)[0], 0, 8);
  EXPECT_EQ(cv::imdecode(record.moments()[1].jpeg, cv::IMREAD_UNCHANGED).channels(), 1);
}

TEST(FollowRecord, ThePageHasTheRouteAndTheMomentsAndNothingOfTheirTextIsMarkup) {
  place::Route route;
  place::Traverse& traverse = route.traverses.emplace_back();
  traverse.name = "</script><script>alert(1)</script>\xff";  // no UTF-8 either
  for (int k = 0; k < 3; ++k)
    traverse.keyframes.push_back({.frame = k, .pose = vo::Pose2{0, 1.0 * k, 0}, .preview_jpeg = {1, 2, 3}});
  traverse.keyframes[2].pose.reset();
  traverse.keyframes[2].preview_jpeg.clear();
  FollowRecord record;
  record.push(moment(0, 0), frame());
  for (const std::size_t keyframe : {1UL, 1UL, 2UL}) {
    place::Position found = moment(1, record.moments().back().position.time_s + 1);
    found.state = place::FollowState::kOnRoute;
    found.place = place::FollowedPlace{.traverse = traverse.name,
                                       .keyframe = keyframe,
                                       .distance_m = {},
                                       .sd_m = {},
                                       .probability = 0.9,
                                       .pose = traverse.keyframes[keyframe].pose};
    record.push(found, frame());
  }
  const std::string page = record.page(route, "<b>walk</b>.mp4");
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;walk&lt;/b&gt;.mp4"));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  const nlohmann::json spec = spec_of(page);
  EXPECT_EQ(spec["traverses"][0]["y"], nlohmann::json({0, 1, nullptr}));
  ASSERT_EQ(spec["samples"].size(), 4U);
  EXPECT_EQ(spec["samples"][0]["state"], "searching");
  EXPECT_FALSE(spec["samples"][0].contains("reference"));
  // One picture of the route, shown twice; none where the route has none.
  EXPECT_EQ(spec["references"].size(), 1U);
  EXPECT_EQ(spec["samples"][1]["reference"], 0);
  EXPECT_EQ(spec["samples"][2]["reference"], 0);
  EXPECT_EQ(spec["samples"][2]["y"], 1);
  EXPECT_FALSE(spec["samples"][3].contains("reference"));
}

TEST(FollowRecord, APageWithoutMomentsIsAPage) {
  place::Route route;
  EXPECT_TRUE(spec_of(FollowRecord().page(route, "-"))["samples"].empty());
}

}  // namespace
