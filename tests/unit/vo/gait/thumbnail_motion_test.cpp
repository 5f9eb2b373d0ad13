#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/gait/thumbnail_motion.hpp>

namespace {

const cv::Size kFrame(640, 360);

/// A smooth scene: waves of 80 to 400 pixels in all directions.
class Scene {
 public:
  Scene() {
    vo::Rng rng(9);
    for (int i = 0; i < 30; ++i) {
      const double length_px = rng.uniform(80, 400), direction = rng.uniform(0, std::numbers::pi);
      waves_.push_back({2 * std::numbers::pi / length_px * std::cos(direction),
                        2 * std::numbers::pi / length_px * std::sin(direction), rng.uniform(0, 6)});
    }
  }
  [[nodiscard]] double at(double x_px, double y_px) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(wave.x * x_px + wave.y * y_px + wave.phase);
    return 128 + 12 * sum;
  }

 private:
  struct Wave {
    double x, y, phase;
  };
  std::vector<Wave> waves_;
};

/// Its thumbnail after everything has moved so far; brighter by so much.
void add(vo::ImageStack& stack, const Scene& scene, const vo::PictureMotion& moved, double brighter = 0) {
  for (int row = 0; row < stack.height; ++row) {
    for (int column = 0; column < stack.width; ++column) {
      // Where the point that is here now was before: the inverse of a turn, a growth and a shift.
      const double x = (column - (stack.width - 1) / 2.0) * kFrame.width / stack.width - moved.right_px;
      const double y = (row - (stack.height - 1) / 2.0) * kFrame.height / stack.height - moved.down_px;
      const double c = 1 + moved.growth, s = moved.roll_rad, size = c * c + s * s;
      const double value = brighter + scene.at((c * x + s * y) / size, (c * y - s * x) / size);
      stack.pixels.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))));
    }
  }
}

TEST(ThumbnailMotion, IsThatOfTheWholePicture) {
  const Scene scene;
  for (const cv::Size size : {cv::Size(64, 32), cv::Size(48, 48), cv::Size(64, 36)}) {
    for (const vo::PictureMotion& moved :
         {vo::PictureMotion{}, vo::PictureMotion{3, -2, 0, 0}, vo::PictureMotion{0.5, 0.25, 0, 0},
          vo::PictureMotion{-12, 20, 0, 0}, vo::PictureMotion{0, 0, 0.03, 0},
          vo::PictureMotion{0, 0, 0, 0.02}, vo::PictureMotion{4, 4, 0.01, -0.01}}) {
      vo::ImageStack stack = vo::make_image_stack(size.width, size.height, 0);
      add(stack, scene, {});
      add(stack, scene, moved, 5);
      const auto motion = vo::thumbnail_motion(stack, kFrame);
      ASSERT_EQ(motion.size(), 2U);
      EXPECT_FALSE(motion[0].picture);
      ASSERT_TRUE(motion[1].picture);
      // Grey levels are rounded, and edges show what was not there; a thumbnail's pixel has ten of the
      // frame's.
      EXPECT_NEAR(motion[1].picture->right_px, moved.right_px, 0.15 + 0.05 * std::abs(moved.right_px));
      EXPECT_NEAR(motion[1].picture->down_px, moved.down_px, 0.15 + 0.05 * std::abs(moved.down_px));
      EXPECT_NEAR(motion[1].picture->growth, moved.growth, 0.002);
      EXPECT_NEAR(motion[1].picture->roll_rad, moved.roll_rad, 0.002);
    }
  }
}

TEST(ThumbnailMotion, IsNoneWhereNothingIsToBeSeen) {
  vo::ImageStack stack = vo::make_image_stack(64, 32, 3);
  for (const auto& motion : vo::thumbnail_motion(stack, kFrame)) EXPECT_FALSE(motion.picture);
  // Columns all alike show no motion down.
  for (std::size_t i = 0; i < stack.pixels.size(); ++i)
    stack.pixels[i] = static_cast<std::uint8_t>(3 * (i % 64));
  for (const auto& motion : vo::thumbnail_motion(stack, kFrame)) EXPECT_FALSE(motion.picture);
  EXPECT_TRUE(vo::thumbnail_motion({}, kFrame).empty());
  EXPECT_EQ(vo::thumbnail_motion(vo::make_image_stack(1, 1, 2), kFrame).size(), 2U);
  EXPECT_FALSE(vo::thumbnail_motion(vo::make_image_stack(2, 2, 2), kFrame)[1].picture);
}

}  // namespace
