#include "support/blob_scene.hpp"
#include "support/seen_points.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vo/base/error.hpp>
#include <vo/surf/surf.hpp>
#include <vo/tracks/view_points.hpp>

namespace {

using testing::IsEmpty;
using vo::ViewPoints;

constexpr double kStep_rad = std::numbers::pi / 65536;

TEST(ViewPoints, AreUnpackedAsTheyWerePacked) {
  std::array<std::int8_t, ViewPoints::kValues> steps{};
  steps[0] = -7;
  steps[1] = 7;
  steps[2] = 2;
  steps[63] = -1;
  std::vector<std::uint8_t> bytes;
  test_support::pack_point(bytes, 1000 * kStep_rad, -2000 * kStep_rad, 0x80 | 72, steps.data());
  ASSERT_EQ(bytes.size(), vo::kViewPointBytes);
  const ViewPoints points = vo::unpack_view_points(bytes);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_FLOAT_EQ(points.azimuth_rad[0], static_cast<float>(1000 * kStep_rad));
  EXPECT_FLOAT_EQ(points.elevation_rad[0], static_cast<float>(-2000 * kStep_rad));
  EXPECT_EQ(points.log2_size[0], 72 / 8.0F - 14);
  EXPECT_EQ(points.laplacian[0], -1);
  EXPECT_EQ(points.descriptor(0)[0], -49);  // steps of the root, so squares
  EXPECT_EQ(points.descriptor(0)[1], 49);
  EXPECT_EQ(points.descriptor(0)[2], 4);
  EXPECT_EQ(points.descriptor(0)[3], 0);
  EXPECT_EQ(points.descriptor(0)[63], -1);
}

TEST(ViewPoints, AreTheStrongestSurfPointsByTheirAngles) {
  constexpr double kFov_deg = 90;  // so that the focal length is half the width
  const cv::Mat picture = test_support::BlobScene(400, 300, 160, 1).draw({640, 360});
  const auto packed = vo::pack_view_points(picture, {.fov_deg = kFov_deg, .calibrated = {}});
  const ViewPoints points = vo::unpack_view_points(packed);
  ASSERT_EQ(points.size(), vo::kMostViewPoints);
  const vo::Features features =
      vo::detect_surf(picture, {.detector = {.max_points = vo::kMostViewPoints}, .upright = true});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = (features.points[i].x_px - 319.5) / 320, y = (features.points[i].y_px - 179.5) / 320;
    // Half a step of the angles, and the rounding of floats.
    EXPECT_NEAR(points.azimuth_rad[i], std::atan(x), 0.51 * kStep_rad);
    EXPECT_NEAR(points.elevation_rad[i], std::asin(y / std::sqrt(x * x + y * y + 1)), 0.51 * kStep_rad);
    EXPECT_NEAR(points.log2_size[i], std::log2(features.points[i].scale_px / 320), 1 / 16.0 + 1e-4);
    EXPECT_EQ(points.laplacian[i], features.points[i].laplacian);
    for (std::size_t v = 0; v < ViewPoints::kValues; ++v) {
      // In the unit of the squares a value v is v * 49 / 0.75; rounding the root by half a step moves it by
      // root + 1/4 at most.
      const double exact = features.descriptor(i)[v] * 49 / 0.75;
      EXPECT_NEAR(points.descriptor(i)[v], exact, std::sqrt(std::abs(exact)) + 0.26);
    }
  }
}

TEST(ViewPoints, AreThoseOfTheNarrowPictureInAWideOneAndInColour) {
  const cv::Mat picture = test_support::BlobScene(60, 250, 130, 2).draw({640, 360});
  cv::Mat colour, wide;
  cv::cvtColor(picture, colour, cv::COLOR_GRAY2BGR);
  cv::resize(picture, wide, {1280, 720}, 0, 0, cv::INTER_NEAREST);  // averaged over 2 x 2 it is the same
  const auto packed = vo::pack_view_points(picture, {});
  EXPECT_FALSE(packed.empty());
  EXPECT_EQ(vo::pack_view_points(colour, {}), packed);
  EXPECT_EQ(vo::pack_view_points(wide, {}), packed);
}

TEST(ViewPoints, AreNoneOfAConstantPictureAndRefuseWhatIsNone) {
  EXPECT_THAT(vo::pack_view_points(cv::Mat1b(360, 640, 90), {}), IsEmpty());
  EXPECT_EQ(vo::unpack_view_points({}).size(), 0U);
  EXPECT_THROW(vo::pack_view_points({}, {}), std::invalid_argument);
  EXPECT_THROW(vo::pack_view_points(cv::Mat1f(36, 64, 1.0F), {}), std::invalid_argument);
  EXPECT_THROW(vo::unpack_view_points(std::vector<std::uint8_t>(38)), vo::Error);
  EXPECT_THROW(vo::unpack_view_points(std::vector<std::uint8_t>(vo::kViewPointBytes * 201)), vo::Error);
}

}  // namespace
