#include "simulate/canvas.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace simulate {
namespace {

TEST(Canvas, FillsTheTexelsOfAnArea) {
  Canvas canvas({10, 5}, {2, 1}, {0, 0, 0});  // five texels a metre
  canvas.fill({0.4, 0.2, 0.6, 0.4}, {1, 2, 3});
  const cv::Mat3b& colour = canvas.painting().colour;
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 10; ++x) {
      const bool inside = x >= 2 && x < 5 && y >= 1 && y < 3;
      EXPECT_EQ(colour(y, x), inside ? cv::Vec3b(1, 2, 3) : cv::Vec3b(0, 0, 0)) << x << " " << y;
    }
  }
}

TEST(Canvas, PaintsNothingInAnAreaOfNoTexels) {
  Canvas canvas({10, 5}, {2, 1}, {9, 9, 9});
  vo::Rng rng(1);
  // Above the canvas, and narrower than half a texel: as a window in what is left of a facade may be.
  for (const cv::Rect2d& area_m : {cv::Rect2d(0, -1, 2, 0.5), cv::Rect2d(0.5, 0.2, 0.01, 0.5)}) {
    canvas.fill(area_m, {1, 2, 3});
    canvas.glow(area_m, {200, 200, 200});
    canvas.text(area_m, "KALO", {1, 2, 3});
    canvas.clutter(area_m, 5, rng);
    canvas.stain(area_m, {0.2, 0.2}, 0.5, 1);
  }
  EXPECT_EQ(cv::norm(canvas.painting().colour, cv::Mat3b(5, 10, cv::Vec3b(9, 9, 9)), cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(canvas.painting().glow, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace simulate
