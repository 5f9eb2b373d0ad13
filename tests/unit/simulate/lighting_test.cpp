#include "simulate/lighting.hpp"

#include <gtest/gtest.h>

namespace simulate {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

TEST(Lighting, NightIsDarkButUnderALamp) {
  const Lamp lamp{{0, 0, 4.5}, {0.2F, 0.5F, 0.7F}};
  const Lighting day(Scene::kStreet, Condition::kDay, {}), night(Scene::kStreet, Condition::kNight, {lamp});
  const auto day_light = day.at({30, 0, 0}, kUp), dark = night.at({30, 0, 0}, kUp),
             lit = night.at({0, 0, 0}, kUp);
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(dark[c], 0.2 * day_light[c]);
    EXPECT_GT(lit[c], 2 * dark[c]);
  }
  EXPECT_GT(lit[2], lit[0]);  // a warm lamp under a blue sky
  EXPECT_GT(dark[0], dark[2]);
  EXPECT_EQ(night.at({0, 0, 0}, -kUp),
            night.at({99, 0, 0}, -kUp));  // what faces away from the lamp has none of it
}

TEST(Lighting, RainIsFlat) {
  const Lighting rain(Scene::kStreet, Condition::kRain, {});
  const Eigen::Vector3d point(0, 0, 5);
  EXPECT_EQ(rain.at(point, Eigen::Vector3d::UnitX()), rain.at(point, -Eigen::Vector3d::UnitX()));
  const Lighting day(Scene::kStreet, Condition::kDay, {});
  EXPECT_NE(day.at(point, Eigen::Vector3d::UnitX()), day.at(point, -Eigen::Vector3d::UnitX()));
  EXPECT_LT(rain.haze().distance_m, day.haze().distance_m);
}

TEST(Lighting, BakesColourGlowAndAlpha) {
  Painting painting;
  painting.colour = cv::Mat3b(2, 2, cv::Vec3b(100, 100, 100));
  painting.glow = cv::Mat3b(2, 2, cv::Vec3b(50, 0, 0));
  painting.alpha = cv::Mat1b(2, 2, std::uint8_t{7});
  const Surface surface{{0, 0, 2}, {2, 0, 0}, {0, 0, -2}, nullptr, 1};
  const Lighting day(Scene::kStreet, Condition::kDay, {}), night(Scene::kStreet, Condition::kNight, {});
  const cv::Vec4b by_day = bake(painting, surface, day)(0, 0),
                  by_night = bake(painting, surface, night)(0, 0);
  EXPECT_EQ(by_day[3], 7);
  EXPECT_EQ(by_day[1], cv::saturate_cast<std::uint8_t>(100 * day.at({1, 0, 1}, Eigen::Vector3d::Zero())[1]));
  EXPECT_EQ(by_night[0],
            50 + cv::saturate_cast<std::uint8_t>(100 * night.at({1, 0, 1}, Eigen::Vector3d::Zero())[0]));
  painting.alpha.release();
  EXPECT_EQ(bake_evenly(painting, {1, 1, 1})(1, 1), cv::Vec4b(100, 100, 100, 255));
}

}  // namespace
}  // namespace simulate
