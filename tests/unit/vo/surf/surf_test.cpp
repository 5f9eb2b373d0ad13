#include "support/blob_scene.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>
#include <vo/surf/descriptor.hpp>
#include <vo/surf/orientation.hpp>
#include <vo/surf/surf.hpp>
#include <vo/tracks/matching.hpp>

namespace {

using test_support::BlobScene;

const cv::Mat& scene() {
  static const cv::Mat picture = BlobScene(300, 160, 100, 1).draw({320, 200});
  return picture;
}

TEST(Surf, IsItsStages) {
  const vo::SurfOptions options{.detector = {.max_points = 50}};
  const auto features = vo::detect_surf(scene(), options);
  const auto points = vo::detect_blobs(vo::integral_image(scene()), options.detector);
  const auto pyramid = vo::smooth_pyramid(scene(), 100);
  ASSERT_EQ(features.size(), 50U);
  ASSERT_EQ(features.descriptor_size, 64U);
  ASSERT_EQ(features.descriptors.size(), 50U * 64);
  for (std::size_t i = 0; i < 50; ++i) {
    vo::Feature point = points[i];
    EXPECT_EQ(features.points[i].x_px, point.x_px);
    point.orientation_rad = vo::orientation(pyramid, point);
    EXPECT_EQ(features.points[i].orientation_rad, point.orientation_rad);
    std::vector<float> values(64);
    vo::describe(pyramid, point, values);
    EXPECT_TRUE(std::ranges::equal(features.descriptor(i), values));
  }
}

TEST(Surf, FindsTheSamePointsInATurnedAndEnlargedImage) {
  const BlobScene blobs(200, 200, 200, 2);
  const double angle = 0.3, scale = 1.2;
  const auto before = vo::detect_surf(blobs.draw({401, 401}));
  const auto after = vo::detect_surf(blobs.draw({401, 401}, angle, scale));
  const auto matches = vo::match_features(before, after);
  std::size_t right = 0;
  for (const auto& match : matches) {
    const auto &a = before.points[match.from], &b = after.points[match.to];
    const double x = a.x_px - 200, y = a.y_px - 200;
    // A blob's place is as sharp as the blob is large: right is what is off by less than its scale.
    right += std::hypot(scale * (std::cos(angle) * x - std::sin(angle) * y) + 200 - b.x_px,
                        scale * (std::sin(angle) * x + std::cos(angle) * y) + 200 - b.y_px) < b.scale_px;
  }
  ASSERT_GE(matches.size(), 60U);
  EXPECT_GE(static_cast<double>(right),
            0.95 * static_cast<double>(matches.size()));  // Lowe's ratio lets through few
}

TEST(Surf, UprightHasNoOrientations) {
  const auto features = vo::detect_surf(scene(), {.upright = true});
  ASSERT_GT(features.size(), 50U);
  for (const auto& point : features.points) EXPECT_EQ(point.orientation_rad, 0);
  // and so descriptors of its own
  EXPECT_NE(features.descriptors, vo::detect_surf(scene()).descriptors);
}

TEST(Surf, ExtendedHas128Values) {
  const auto features = vo::detect_surf(scene(), {.extended = true});
  EXPECT_EQ(features.descriptor_size, 128U);
  EXPECT_EQ(features.descriptors.size(), 128 * features.size());
  EXPECT_EQ(features.size(), vo::detect_surf(scene()).size());
}

TEST(Surf, IsTheSameForAnyThreadCount) {
  const cv::Mat picture = test_support::noise_picture({400, 300}, 1);
  vo::set_thread_count(1);
  const auto one = vo::detect_surf(picture);
  for (const int threads : {2, 5}) {
    vo::set_thread_count(threads);
    const auto some = vo::detect_surf(picture);
    ASSERT_EQ(some.size(), one.size());
    EXPECT_EQ(some.descriptors, one.descriptors);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(some.points[i].x_px, one.points[i].x_px);
      EXPECT_EQ(some.points[i].orientation_rad, one.points[i].orientation_rad);
      EXPECT_EQ(some.points[i].response, one.points[i].response);
    }
  }
  vo::set_thread_count(0);
}

TEST(Surf, OfAPartOfAnImageIsThatOfItsCopy) {
  const cv::Mat part = scene()(cv::Rect(21, 13, 200, 150));
  EXPECT_EQ(vo::detect_surf(part).descriptors, vo::detect_surf(part.clone()).descriptors);
}

TEST(Surf, OfImagesWithNothingInThem) {
  for (const cv::Mat& image :
       {cv::Mat(), cv::Mat(1, 1, CV_8UC1, cv::Scalar(7)), test_support::noise_picture({20, 300}, 1),
        cv::Mat(300, 300, CV_8UC1, cv::Scalar(7))}) {
    const auto features = vo::detect_surf(image, {.extended = true});
    EXPECT_EQ(features.size(), 0U);
    EXPECT_TRUE(features.descriptors.empty());
    EXPECT_EQ(features.descriptor_size, 128U);
  }
}

TEST(Surf, RefusesWhatIsNoGreyImage) {
  EXPECT_THROW(vo::detect_surf(cv::Mat(50, 50, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(vo::detect_surf(cv::Mat(50, 50, CV_32FC1)), std::invalid_argument);
  EXPECT_THROW(vo::detect_surf(cv::Mat(50, 50, CV_8SC1)), std::invalid_argument);
  EXPECT_THROW(vo::detect_surf(scene(), {.detector = {.threshold = -1}}), std::invalid_argument);
}

}  // namespace
