#include "support/blob_scene.hpp"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vo/base/parallel.hpp>
#include <vo/tracks/klt_tracking.hpp>

namespace {

const cv::Size kSize{320, 240};

/// The picture of blobs, moved by so many pixels.
cv::Mat moved(double dx, double dy) {
  static const cv::Mat large = test_support::BlobScene(400, 250, 200, 3).draw({480, 360});
  cv::Mat picture;
  const cv::Matx23d map(1, 0, dx - 80, 0, 1, dy - 60);
  cv::warpAffine(large, picture, map, kSize, cv::INTER_CUBIC);
  return picture;
}

std::vector<cv::Point2f> grid() {
  std::vector<cv::Point2f> points;
  for (int y = 40; y <= 200; y += 20) {
    for (int x = 40; x <= 280; x += 20) points.emplace_back(x, y);
  }
  return points;
}

TEST(KltTracking, FollowsAShift) {
  const auto from = grid();
  const auto found = vo::follow(vo::klt_pyramid(moved(0, 0)), vo::klt_pyramid(moved(5.3, -3.6)), from, from);
  std::size_t count = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (!found[i]) continue;  // on bare ground between the blobs
    ++count;
    EXPECT_NEAR(found[i]->x - from[i].x, 5.3, 0.15);  // interpolation and bytes
    EXPECT_NEAR(found[i]->y - from[i].y, -3.6, 0.15);
  }
  EXPECT_GT(count, from.size() * 3 / 4);
}

TEST(KltTracking, LooksFirstWhereItIsTold) {
  const auto from = grid();
  std::vector<cv::Point2f> guess;
  for (const cv::Point2f& p : from) guess.emplace_back(p.x + 30, p.y);
  const vo::KltOptions flat{.levels = 0};  // sees no further than its window
  const auto before = vo::klt_pyramid(moved(0, 0), flat), after = vo::klt_pyramid(moved(31, 0), flat);
  const auto count = [&](const std::vector<cv::Point2f>& at) {
    std::size_t right = 0;
    const auto found = vo::follow(before, after, from, at, flat);
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (found[i] && std::abs(found[i]->x - from[i].x - 31) < 0.3) ++right;
    }
    return right;
  };
  EXPECT_GT(count(guess), from.size() / 2);
  EXPECT_LT(count(from), from.size() / 10);
}

TEST(KltTracking, DoesNotFindWhatIsGone) {
  const auto from = grid();
  const auto before = vo::klt_pyramid(moved(0, 0));
  for (const auto& at : vo::follow(before, vo::klt_pyramid(cv::Mat1b(kSize, uchar{0})), from, from))
    EXPECT_FALSE(at);
  std::size_t by_chance = 0;
  for (const auto& at :
       vo::follow(before, vo::klt_pyramid(test_support::noise_picture(kSize, 2)), from, from)) {
    if (at) ++by_chance;
  }
  EXPECT_LT(by_chance, from.size() / 5);
  for (const auto& at : vo::follow(before, vo::klt_pyramid(moved(-300, 0)), from, from)) EXPECT_FALSE(at);
}

TEST(KltTracking, IsTheSameForAnyThreadCount) {
  const auto from = grid();
  const auto before = vo::klt_pyramid(moved(0, 0)), after = vo::klt_pyramid(moved(2.5, 1));
  vo::set_thread_count(1);
  const auto one = vo::follow(before, after, from, from);
  vo::set_thread_count(3);
  EXPECT_EQ(vo::follow(before, after, from, from), one);
  vo::set_thread_count(0);
}

TEST(KltTracking, RefusesWhatDoesNotFit) {
  const auto pyramid = vo::klt_pyramid(moved(0, 0));
  const std::vector<cv::Point2f> one(1);
  EXPECT_TRUE(vo::follow(pyramid, pyramid, {}, {}).empty());
  EXPECT_THROW(vo::follow(pyramid, pyramid, one, {}), std::invalid_argument);
  EXPECT_THROW(vo::follow(pyramid, {}, one, one), std::invalid_argument);
  EXPECT_THROW(vo::klt_pyramid(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(vo::klt_pyramid(moved(0, 0), {.window_px = 4}), std::invalid_argument);
}

}  // namespace
