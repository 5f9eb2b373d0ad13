#include "support/blob_scene.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vo/base/parallel.hpp>
#include <vo/surf/hessian_detector.hpp>

namespace {

using test_support::gaussian_blob;
using test_support::noise_picture;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<vo::Feature> detect(const cv::Mat& grey, const vo::HessianOptions& options = {}) {
  return vo::detect_blobs(vo::integral_image(grey), options);
}

bool equal(const vo::Feature& a, const vo::Feature& b) {
  return a.x_px == b.x_px && a.y_px == b.y_px && a.scale_px == b.scale_px && a.response == b.response &&
         a.laplacian == b.laplacian;
}

/// The response of one filter of side 3 l by its definition (Bay 2008, Fig. 2), pixel by pixel.
double response(const cv::Mat1b& grey, int l, int x, int y) {
  const int reach = (3 * l - 1) / 2;
  double dxx = 0, dyy = 0, dxy = 0;
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      const double pixel = grey(y + v, x + u);
      if (std::abs(v) < l) dxx += std::abs(u) <= (l - 1) / 2 ? -2 * pixel : pixel;
      if (std::abs(u) < l) dyy += std::abs(v) <= (l - 1) / 2 ? -2 * pixel : pixel;
      if (u != 0 && v != 0 && std::abs(u) <= l && std::abs(v) <= l)
        dxy += (u > 0) == (v > 0) ? pixel : -pixel;
    }
  }
  return (dxx * dyy - 0.81 * dxy * dxy) / std::pow(3 * l, 4);
}

TEST(HessianDetector, WorkedExample) {
  // A square of 5 x 5 at 200 with 3 x 3 at 60 in it: 16 * 200 + 9 * 60 = 3740 in all. The middle lobes of
  // sides 5 and 7 hold all of it, so Dxx = Dyy = -2 * 3740. That of side 3 has columns of 2 * 200 + 3 * 60 =
  // 580 in the middle and, on either side, one of 5 * 200: Dxx = Dyy = -2 * 3 * 580 + 2 * 1000 = -1480. Dxy =
  // 0.
  cv::Mat1b grey(99, 99, uchar{0});
  grey(cv::Rect(47, 47, 5, 5)) = 200;
  grey(cv::Rect(48, 48, 3, 3)) = 60;
  const double below = std::pow(1480.0 / 81, 2), at = std::pow(7480.0 / 225, 2),
               above = std::pow(7480.0 / 441, 2);
  const auto points = detect(grey, {.threshold = 500, .octaves = 1});
  ASSERT_THAT(points, SizeIs(1));
  EXPECT_FLOAT_EQ(points[0].x_px, 49);  // by symmetry
  EXPECT_FLOAT_EQ(points[0].y_px, 49);
  EXPECT_EQ(points[0].laplacian, -1);
  // The parabola through the three, an interval being 2 of the lobe's 5 pixels.
  const double slope = (above - below) / 2, curvature = above + below - 2 * at;
  EXPECT_FLOAT_EQ(points[0].scale_px, static_cast<float>(1.2 / 3 * (5 - 2 * slope / curvature)));
  EXPECT_FLOAT_EQ(points[0].response, static_cast<float>(at - slope * slope / curvature / 2));
}

/// The scale of the filter that responds most to a Gaussian blob it is centred on: the integrals over its
/// lobes are error functions.
double best_scale(double sigma, double step_px) {
  const auto within = [&](double width_px) { return std::erf(width_px / (2 * std::sqrt(2.0) * sigma)); };
  double best = 0, greatest = 0;
  for (double lobe = 3; lobe < 12; lobe += 0.01) {
    const double derivative = within(step_px * (2 * lobe - 1)) *
                              (3 * within(step_px * lobe) - within(step_px * 3 * lobe)) / (lobe * lobe);
    if (derivative > greatest) {
      greatest = derivative;
      best = 1.2 / 3 * lobe * step_px;
    }
  }
  return best;
}

TEST(HessianDetector, FindsABlobWhereItIs) {
  for (const double height : {100.0, -100.0}) {
    for (const double sigma : {2.5, 3.5, 5.0, 9.0}) {
      const double x = 150.3, y = 139.6;
      const auto points = detect(gaussian_blob({300, 280}, x, y, sigma, height));
      ASSERT_FALSE(points.empty()) << sigma;
      // The quadratic is no Gaussian: a tenth of the sampling step, which is at most 4 pixels for these.
      const double step = sigma < 3.2 ? 1 : sigma < 6.4 ? 2 : 4;
      EXPECT_NEAR(points[0].x_px, x, 0.1 * step) << sigma;
      EXPECT_NEAR(points[0].y_px, y, 0.1 * step) << sigma;
      // The quadratic through filters a factor 1.3 apart is right to a tenth; the wrong filter would not be.
      EXPECT_NEAR(points[0].scale_px / best_scale(sigma, step), 1, 0.1) << sigma;
      EXPECT_EQ(points[0].laplacian, height < 0 ? 1 : -1);
    }
  }
}

TEST(HessianDetector, AgreesWithTheDefinition) {
  cv::Mat1b grey;
  cv::GaussianBlur(noise_picture({72, 66}, 4), grey, {}, 1.5);
  // Maxima of the two middle filters of an octave, by comparing each with its 26 neighbours.
  std::vector<cv::Vec3i> expected;
  const auto at = [&](int i, int x, int y) { return response(grey, 3 + 2 * i, x, y); };
  for (int i = 1; i <= 2; ++i) {
    const int margin = (3 * (5 + 2 * i) - 1) / 2 + 1;
    for (int y = margin; y < grey.rows - margin; ++y) {
      for (int x = margin; x < grey.cols - margin; ++x) {
        const double centre = at(i, x, y);
        bool greatest = centre >= 1;
        for (int n = 0; n < 27 && greatest; ++n)
          greatest = n == 13 || centre > at(i - 1 + n / 9, x - 1 + n % 3, y - 1 + n / 3 % 3);
        if (greatest) expected.push_back({i, x, y});
      }
    }
  }
  ASSERT_GE(expected.size(), 5U);
  const auto points = detect(grey, {.threshold = 1, .max_points = 0, .octaves = 1, .rim_scales = 0});
  // A point is refined by at most one sample in each direction, and dropped if that would not do.
  EXPECT_GE(points.size(), expected.size() * 8 / 10);
  for (const auto& point : points) {
    const double interval = (point.scale_px * 3 / 1.2 - 3) / 2;
    EXPECT_TRUE(std::ranges::any_of(expected,
                                    [&](const cv::Vec3i& e) {
                                      return std::abs(interval - e[0]) <= 1.001 &&
                                             std::abs(point.x_px - e[1]) <= 1.001 &&
                                             std::abs(point.y_px - e[2]) <= 1.001;
                                    }))
        << point.x_px << ' ' << point.y_px;
  }
}

TEST(HessianDetector, OctavesAreAlike) {
  // Every pixel doubled: what the second octave sees of it is what the first sees of the original.
  const cv::Mat grey = noise_picture({60, 60}, 5);
  cv::Mat doubled;
  cv::resize(grey, doubled, {}, 2, 2, cv::INTER_NEAREST);
  const auto once = detect(grey, {.threshold = 5, .octaves = 1, .rim_scales = 0});
  const auto twice = detect(doubled, {.threshold = 5, .octaves = 1, .initial_step_px = 2, .rim_scales = 0});
  ASSERT_FALSE(once.empty());
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(twice[i].x_px, 2 * once[i].x_px + 0.5F);
    EXPECT_EQ(twice[i].y_px, 2 * once[i].y_px + 0.5F);
    EXPECT_EQ(twice[i].scale_px, 2 * once[i].scale_px);
    EXPECT_FLOAT_EQ(twice[i].response, once[i].response);
  }
}

TEST(HessianDetector, KeepsTheStrongest) {
  const cv::Mat grey = noise_picture({200, 150}, 6);
  const auto all = detect(grey, {.threshold = 1, .max_points = 0});
  const auto some = detect(grey, {.threshold = 1, .max_points = 20});
  ASSERT_GT(all.size(), 40U);
  ASSERT_THAT(some, SizeIs(20));
  for (std::size_t i = 0; i < 20; ++i) EXPECT_TRUE(equal(all[i], some[i]));
  const auto strength = [](const vo::Feature& point) { return point.response * std::sqrt(point.scale_px); };
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_LE(strength(all[i]), strength(all[i - 1]));
}

TEST(HessianDetector, OfEqualResponsesOneIsTheMaximum) {
  // The middle of the blob is between four pixels, whose responses are equal.
  EXPECT_THAT(detect(gaussian_blob({100, 100}, 49.5, 49.5, 3, 100), {.threshold = 200}), SizeIs(1));
}

TEST(HessianDetector, KeepsAwayFromTheRim) {
  for (const auto& point : detect(noise_picture({120, 100}, 7), {.threshold = 1, .rim_scales = 10})) {
    EXPECT_GE(std::min(point.x_px, point.y_px), 10 * point.scale_px);
    EXPECT_LE(point.x_px, 119 - 10 * point.scale_px);
    EXPECT_LE(point.y_px, 99 - 10 * point.scale_px);
  }
}

TEST(HessianDetector, OfImagesWithNothingInThem) {
  EXPECT_THAT(detect(cv::Mat()), IsEmpty());
  EXPECT_THAT(detect(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9))), IsEmpty());
  EXPECT_THAT(detect(noise_picture({28, 28}, 1)), IsEmpty());
  EXPECT_THAT(detect(noise_picture({1000, 3}, 1)), IsEmpty());
  EXPECT_THAT(detect(cv::Mat(200, 200, CV_8UC1, cv::Scalar(255)), {.threshold = 1e-6F}), IsEmpty());
}

TEST(HessianDetector, RefusesWrongOptions) {
  const cv::Mat grey = noise_picture({40, 40}, 1);
  EXPECT_THROW(detect(grey, {.threshold = 0}), std::invalid_argument);
  EXPECT_THROW(detect(grey, {.threshold = std::numeric_limits<float>::quiet_NaN()}), std::invalid_argument);
  EXPECT_THROW(detect(grey, {.octaves = 0}), std::invalid_argument);
  EXPECT_THROW(detect(grey, {.octaves = 9}), std::invalid_argument);
  EXPECT_THROW(detect(grey, {.intervals = 2}), std::invalid_argument);
  EXPECT_THROW(detect(grey, {.initial_step_px = 3}), std::invalid_argument);
  EXPECT_THROW(detect(grey, {.rim_scales = -1}), std::invalid_argument);
  std::string error;
  EXPECT_FALSE(vo::HessianOptions{.intervals = 7}.is_valid(&error));
  EXPECT_THAT(error, testing::HasSubstr("intervals"));
}

}  // namespace
