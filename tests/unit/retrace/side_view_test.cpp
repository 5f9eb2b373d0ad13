#include "side_view.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace retrace {
namespace {

const cv::Scalar kGreen(0, 200, 0), kBlue(200, 0, 0);

/// Whether a pixel has the colour.
bool has_colour(const cv::Mat& page, cv::Point at, const cv::Scalar& colour) {
  const cv::Vec3b pixel = page.at<cv::Vec3b>(at);
  return pixel[0] == colour[0] && pixel[1] == colour[1] && pixel[2] == colour[2];
}

SideView view_of(std::optional<double> along) {
  return {.query = cv::Mat(48, 96, CV_8UC3, kGreen),
          .reference = along ? cv::Mat(96, 96, CV_8UC3, kBlue) : cv::Mat(),
          .query_caption = "query",
          .reference_caption = "reference",
          .along = along,
          .status = "12.0 m",
          .route_end = "40.0 m"};
}

TEST(SideView, PicturesHaveTheirShapesInEvenPixelsAndAreNotTooHigh) {
  const SideViewLayout layout = side_view_layout({848, 480}, {1080, 1920}, 641);
  EXPECT_EQ(layout.query, cv::Size(642, 364));      // 642 * 480 / 848 is 363.4
  EXPECT_EQ(layout.reference, cv::Size(642, 482));  // three quarters are 481.5
  EXPECT_EQ(layout.size().width, 642);
  EXPECT_EQ(layout.size().height % 2, 0);
  EXPECT_EQ(side_view_layout({640, 360}, {640, 360}, 640).query, cv::Size(640, 360));
}

TEST(SideView, TheQueryIsAboveAndTheReferenceInTheMiddleBelow) {
  const SideViewLayout layout = side_view_layout({96, 48}, {96, 48}, 320);
  const cv::Mat page = draw_side_view(view_of(0.5), layout);
  ASSERT_EQ(page.size(), layout.size());
  EXPECT_TRUE(has_colour(page, {310, 80}, kGreen));
  EXPECT_TRUE(has_colour(page, {160, 160 + 80}, kBlue));
  EXPECT_TRUE(has_colour(page, {160 + 79, 160 + 150}, kBlue));   // a square of 160 in the middle of 320
  EXPECT_FALSE(has_colour(page, {160 + 81, 160 + 150}, kBlue));  // beside it is nothing
}

TEST(SideView, TheMarkerStandsWhereTheWalkerIs) {
  const SideViewLayout layout = side_view_layout({96, 48}, {96, 48}, 320);
  const cv::Point begin = layout.bar_begin(), end = layout.bar_end();
  const cv::Mat off_route = draw_side_view(view_of({}), layout);
  for (const double along : {0.0, 0.25, 1.0}) {
    const cv::Mat page = draw_side_view(view_of(along), layout);
    cv::Mat differs;
    cv::absdiff(page, off_route, differs);
    // Above the bar's own line only the marker reaches.
    const cv::Mat above = differs.row(begin.y - 5);
    double left = 0;
    int count = 0;
    for (int x = 0; x < above.cols; ++x) {
      if (above.at<cv::Vec3b>(0, x)[2] < 60) continue;
      left += x;
      ++count;
    }
    ASSERT_GT(count, 0) << along;
    EXPECT_NEAR(left / count, begin.x + along * (end.x - begin.x), 1) << along;
  }
}

TEST(SideView, LongCaptionsAreMadeToFit) {
  SideView view = view_of({});
  view.query = cv::Mat(48, 96, CV_8UC3, cv::Scalar(0, 0, 0));
  view.query_caption = std::string(60, 'M');
  const cv::Mat page = draw_side_view(view, side_view_layout({96, 48}, {96, 48}, 320));
  double brightest = 0;
  cv::minMaxLoc(page(cv::Rect(0, 0, 300, 22)).clone().reshape(1), nullptr, &brightest);
  EXPECT_GT(brightest, 100);
  cv::minMaxLoc(page(cv::Rect(310, 0, 10, 22)).clone().reshape(1), nullptr, &brightest);
  EXPECT_LT(brightest, 20);
}

TEST(SideView, OffTheRouteNothingIsShownButWords) {
  const SideViewLayout layout = side_view_layout({96, 48}, {96, 48}, 320);
  const cv::Mat page = draw_side_view(view_of({}), layout);
  EXPECT_TRUE(has_colour(page, {310, 80}, kGreen));
  const cv::Mat below = page(cv::Rect({0, 160 + 1}, cv::Size(320, 159)));
  EXPECT_LT(cv::mean(below)[0], 60);
  double brightest = 0;
  cv::minMaxLoc(below.reshape(1), nullptr, &brightest);
  EXPECT_GT(brightest, 200);
}

}  // namespace
}  // namespace retrace
