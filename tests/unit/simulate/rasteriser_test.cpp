#include "simulate/rasteriser.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace simulate {
namespace {

std::shared_ptr<const Texture> plain(int blue, int green, int red) {
  return std::make_shared<const Texture>(cv::Mat(4, 4, CV_8UC4, cv::Scalar(blue, green, red, 255)));
}

// A square that faces a camera at the origin looking along z.
Surface square(double z, double half, std::shared_ptr<const Texture> texture) {
  return {{-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0}, std::move(texture), 1};
}

Camera camera_of(cv::Size size, double focal_px) {
  Camera camera;
  camera.size = size;
  camera.focal_px = focal_px;
  return camera;
}

TEST(Rasteriser, CoversThePixelsWhoseCentresLieInside) {
  cv::Mat image;
  // Two metres wide, ten away, 50 px focal length: 10 px.
  rasterise({square(10, 1, plain(255, 0, 0))}, {}, camera_of({40, 20}, 50), {}, image);
  cv::Mat blue;
  cv::extractChannel(image, blue, 0);
  EXPECT_EQ(cv::countNonZero(blue), 100);
  EXPECT_EQ(cv::countNonZero(blue(cv::Rect(15, 5, 10, 10))), 100);
}

TEST(Rasteriser, ShowsWhatIsNearestInAnyOrder) {
  const Surface near = square(5, 0.5, plain(0, 255, 0)), far = square(8, 4, plain(0, 0, 255));
  Surface slanting = far;  // its corner is nearest of all, its middle is not
  slanting.corner = {-4, -4, 2};
  slanting.across = {8, 0, 12};
  cv::Mat a, b;
  rasterise({near, far, slanting}, {}, camera_of({64, 48}, 60), {}, a);
  rasterise({slanting, far, near}, {}, camera_of({64, 48}, 60), {}, b);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0);
  EXPECT_EQ(a.at<cv::Vec3b>(24, 32), cv::Vec3b(0, 255, 0));
}

TEST(Rasteriser, IsExactInPerspective) {
  // A floor 1 m below, blue growing with the distance: every pixel must show the distance its ray meets.
  cv::Mat4b ramp(250, 4);
  for (int y = 0; y < ramp.rows; ++y)
    ramp.row(y).setTo(cv::Vec4b(cv::saturate_cast<std::uint8_t>(250 - y), 0, 0, 255));
  const Surface floor{{-50, 1, 25}, {100, 0, 0}, {0, 0, -25}, std::make_shared<const Texture>(ramp), 1};
  const Camera camera = camera_of({64, 64}, 40);
  cv::Mat image;
  rasterise({floor}, {}, camera, {}, image);
  for (int y = 40; y < 64; ++y) {
    const double z = camera.focal_px / (y + 0.5 - 32);  // at height 1
    // Ten grey levels a metre. Mip levels blur a linear ramp evenly; rounding adds a level or two.
    EXPECT_NEAR(image.at<cv::Vec3b>(y, 20)[0], 10 * z, 3) << y;
  }
}

TEST(Rasteriser, ClipsWhatReachesBehindTheCamera) {
  const Surface floor{{-50, 1, 50}, {100, 0, 0}, {0, 0, -100}, plain(9, 9, 9), 1};
  cv::Mat image;
  rasterise({floor}, {}, camera_of({40, 40}, 30), {}, image);
  EXPECT_EQ(image.at<cv::Vec3b>(39, 0), cv::Vec3b(9, 9, 9));
  EXPECT_EQ(image.at<cv::Vec3b>(39, 39), cv::Vec3b(9, 9, 9));
  EXPECT_EQ(image.at<cv::Vec3b>(19, 20), cv::Vec3b(0, 0, 0));
}

TEST(Rasteriser, CutsOutWhereAlphaIsLow) {
  cv::Mat4b ring(64, 64, cv::Vec4b(200, 200, 200, 255));
  ring(cv::Rect(16, 16, 32, 32)).setTo(cv::Vec4b(200, 200, 200, 0));
  cv::Mat image;
  rasterise({square(4, 1, std::make_shared<const Texture>(ring)), square(6, 9, plain(0, 0, 77))}, {},
            camera_of({64, 64}, 100), {}, image);
  EXPECT_EQ(image.at<cv::Vec3b>(32, 32), cv::Vec3b(0, 0, 77));
  EXPECT_EQ(image.at<cv::Vec3b>(32, 10), cv::Vec3b(200, 200, 200));
}

TEST(Rasteriser, HazesByDistanceButNotTheBackdrop) {
  cv::Mat image;
  rasterise({square(10, 1, plain(0, 0, 0))}, {square(1, 3, plain(50, 0, 0))}, camera_of({40, 20}, 50),
            {{200, 200, 200}, 10}, image);
  // 1 - 1/e of the haze; two roundings to 1/256.
  EXPECT_NEAR(image.at<cv::Vec3b>(10, 20)[1], 200 * (1 - std::exp(-1.0)), 2);
  EXPECT_EQ(image.at<cv::Vec3b>(1, 1), cv::Vec3b(50, 0, 0));
}

TEST(Rasteriser, DrawsNothingFromNothing) {
  cv::Mat image;
  rasterise({}, {}, camera_of({7, 5}, 5), {}, image);
  EXPECT_EQ(image.size(), cv::Size(7, 5));
  EXPECT_EQ(cv::norm(image, cv::NORM_INF), 0);
}

TEST(Rasteriser, DoesNotDependOnThreads) {
  vo::Rng rng(3);
  const auto any = [&](double by) {
    return Eigen::Vector3d(rng.uniform(-by, by), rng.uniform(-by, by), rng.uniform(-by, by));
  };
  std::vector<Surface> surfaces;
  for (int i = 0; i < 60; ++i) {
    cv::Mat4b noise(32, 32);
    for (auto& texel : noise)
      texel = cv::Vec4b(static_cast<std::uint8_t>(rng.bits()), static_cast<std::uint8_t>(rng.bits()), 0,
                        i % 2 == 0 ? 255 : static_cast<std::uint8_t>(rng.bits()));
    surfaces.push_back(
        {any(8) + Eigen::Vector3d(0, 0, 9), any(5), any(5), std::make_shared<const Texture>(noise), 1});
  }
  cv::Mat one, many;
  vo::set_thread_count(1);
  rasterise(surfaces, {}, camera_of({160, 90}, 120), {}, one);
  vo::set_thread_count(4);
  rasterise(surfaces, {}, camera_of({160, 90}, 120), {}, many);
  vo::set_thread_count(0);
  EXPECT_EQ(cv::norm(one, many, cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(one, cv::NORM_INF), 0);
}

TEST(Camera, ProjectsWhereTheRasteriserDraws) {
  Camera camera = camera_of({200, 100}, 150);
  camera.world_from_camera.linear() =
      Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  camera.world_from_camera.translation() << 1, 2, 3;
  const Eigen::Vector3d centre = camera.world_from_camera * Eigen::Vector3d(0.4, -0.2, 6);
  Surface target = square(0, 0.3, plain(255, 255, 255));
  target.across = camera.world_from_camera.linear().col(0) * 0.6;
  target.down = camera.world_from_camera.linear().col(1) * 0.6;
  target.corner = centre - target.across / 2 - target.down / 2;
  cv::Mat image, mask;
  rasterise({target}, {}, camera, {}, image);
  cv::extractChannel(image, mask, 0);
  double x = 0, y = 0;
  const int count = cv::countNonZero(mask);
  for (int r = 0; r < mask.rows; ++r) {
    for (int c = 0; c < mask.cols; ++c) {
      if (mask.at<std::uint8_t>(r, c) == 0) continue;
      x += (c + 0.5) / count;
      y += (r + 0.5) / count;
    }
  }
  const Eigen::Vector2d expected = camera.project(centre);
  // A 15 px square: its edges, all in phase, may shift the centroid by half a pixel.
  EXPECT_NEAR(x, expected.x(), 0.51);
  EXPECT_NEAR(y, expected.y(), 0.51);
}

}  // namespace
}  // namespace simulate
