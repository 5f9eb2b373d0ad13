#include "people.hpp"

#include "canvas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace simulate {
namespace {

const cv::Size kTexels(112, 224);
constexpr double kVisible_m = 60;
constexpr double kArmLength_m = 0.5;  // nearer than this no one passes in front of a chest
const cv::Vec3f kNightTint(0.45F, 0.75F, 1.0F);

struct Clothes {
  Colour skin, hair, top, trousers, shoes, bag;
  bool has_bag, long_hair;
};

// One figure at a phase of its stride; 1 unit is the figure's height.
Painting paint_figure(const Clothes& clothes, double swing) {
  Painting painting;
  painting.colour.create(kTexels);
  painting.colour.setTo(clothes.top);
  painting.alpha = cv::Mat1b::zeros(kTexels);
  const auto at = [](double x, double y) {
    return cv::Point(static_cast<int>((0.5 + x * 2) * kTexels.width / 2 + kTexels.width / 4.0),
                     static_cast<int>(y * kTexels.height));
  };
  const auto limb = [&](cv::Point a, cv::Point b, double width, const Colour& colour) {
    const int w = std::max(2, static_cast<int>(width * kTexels.height));
    cv::line(painting.colour, a, b, colour, w, cv::LINE_AA);
    cv::line(painting.alpha, a, b, 255, w);
  };
  const auto blob = [&](cv::Point centre, double rx, double ry, const Colour& colour) {
    const cv::Size radii(static_cast<int>(rx * kTexels.height), static_cast<int>(ry * kTexels.height));
    cv::ellipse(painting.colour, centre, radii, 0, 0, 360, colour, cv::FILLED, cv::LINE_AA);
    cv::ellipse(painting.alpha, centre, radii, 0, 0, 360, 255, cv::FILLED);
  };
  for (const double side : {-1.0, 1.0}) {
    const double forward = side * swing;  // a leg that swings forward is bent and lifted
    const cv::Point hip = at(side * 0.045, 0.5), knee = at(side * 0.05 + 0.03 * forward, 0.72);
    const cv::Point foot = at(side * 0.05 + 0.05 * forward, 0.96 - 0.03 * std::max(0.0, forward));
    limb(hip, knee, 0.075, clothes.trousers);
    limb(knee, foot, 0.06, scaled(clothes.trousers, 0.9));
    blob(foot, 0.035, 0.018, clothes.shoes);
    limb(at(side * 0.10, 0.22), at(side * 0.125 - 0.03 * forward, 0.38), 0.05, scaled(clothes.top, 0.85));
    limb(at(side * 0.125 - 0.03 * forward, 0.38), at(side * 0.12 - 0.05 * forward, 0.5), 0.04, clothes.skin);
  }
  limb(at(0, 0.24), at(0, 0.48), 0.19, clothes.top);
  limb(at(-0.06, 0.2), at(0.06, 0.2), 0.07, clothes.top);
  limb(at(0, 0.2), at(0, 0.52), 0.012, scaled(clothes.top, 0.5));
  if (clothes.has_bag) limb(at(0.1, 0.42), at(0.1, 0.52), 0.09, clothes.bag);
  if (clothes.long_hair) blob(at(0, 0.1), 0.06, 0.1, clothes.hair);
  blob(at(0, 0.09), 0.045, 0.065, clothes.skin);
  blob(at(0, 0.045), 0.047, 0.035, clothes.hair);
  return painting;
}

Passer draw_passer(bool night, vo::Rng& rng) {
  const auto any = [&](double saturation, double value) {
    const double hue = rng.uniform(0, 360);
    return hsv({hue, saturation * rng.uniform(), value * rng.uniform(0.3, 1)});
  };
  Clothes clothes{};
  clothes.skin = scaled(Colour(140, 170, 225), rng.uniform(0.4, 1));
  clothes.hair = scaled(Colour(60, 90, 130), rng.uniform(0.2, 1.2));
  clothes.top = any(0.9, 0.9);
  clothes.trousers = any(0.5, 0.6);
  clothes.shoes = any(0.2, 0.5);
  clothes.bag = any(0.8, 0.8);
  clothes.has_bag = rng.index(2) == 0;
  clothes.long_hair = rng.index(2) == 0;
  Passer passer{};
  passer.height_m = rng.uniform(1.55, 1.9);
  for (std::size_t i = 0; i < passer.strides.size(); ++i) {
    const double swing = std::sin(2 * std::numbers::pi * static_cast<double>(i) / 4 + 0.4);
    passer.strides[i] = std::make_shared<const Texture>(
        bake_evenly(paint_figure(clothes, swing), night ? kNightTint : cv::Vec3f(1, 1, 1)));
  }
  return passer;
}

}  // namespace

std::vector<Passer> draw_people(int count, double duration_s,
                                const std::function<double(double)>& distance_at, double walker_right_m,
                                double room_m, bool night, std::uint64_t seed) {
  vo::Rng rng = vo::Rng(seed).split();
  std::vector<Passer> people;
  for (int i = 0; i < count; ++i) {
    Passer passer = draw_passer(night, rng);
    // Two in three come towards the walker, the others overtake or are overtaken.
    const double meet_s = (i + rng.uniform(0.2, 0.8)) / count * duration_s;
    const double speed = rng.uniform(1.0, 1.6);
    passer.speed_mps = rng.index(3) == 0 ? speed : -speed;
    passer.begin_m = distance_at(meet_s) - passer.speed_mps * meet_s;
    const double side = rng.index(2) == 0 ? 1 : -1;
    passer.right_m = std::clamp(walker_right_m + side * rng.uniform(0.6, 1.5), -room_m, room_m);
    if (std::abs(passer.right_m - walker_right_m) < kArmLength_m)
      passer.right_m = walker_right_m - side * 0.6;
    people.push_back(std::move(passer));
  }
  return people;
}

std::vector<Surface> people_at(const std::vector<Passer>& people, const Path& route, double time_s,
                               const Eigen::Vector3d& camera, const Lighting& lighting) {
  std::vector<Surface> figures;
  for (const Passer& passer : people) {
    const double along_m = passer.begin_m + passer.speed_mps * time_s;
    const vo::Pose2 pose = moved_right(route.at(along_m), passer.right_m);
    const Eigen::Vector2d feet(pose.x_m, pose.y_m);
    const Eigen::Vector2d to = feet - camera.head<2>();
    if (to.norm() > kVisible_m || to.norm() < kArmLength_m) continue;
    const Eigen::Vector2d half = Eigen::Vector2d(to.y(), -to.x()).normalized() * (passer.height_m / 4);
    // A step of 0.7 m: a stride of four pictures every 1.4 m.
    const double stride = std::abs(along_m) / 1.4;
    const auto picture = static_cast<std::size_t>(4 * (stride - std::floor(stride)));
    const cv::Vec3f light = lighting.at({feet.x(), feet.y(), 1.2}, Eigen::Vector3d::Zero());
    const double gain = std::min(1.0, static_cast<double>(std::max({light[0], light[1], light[2]})));
    figures.push_back({{feet.x() - half.x(), feet.y() - half.y(), passer.height_m},
                       {2 * half.x(), 2 * half.y(), 0},
                       {0, 0, -passer.height_m},
                       passer.strides[std::min<std::size_t>(picture, 3)],
                       gain});
  }
  return figures;
}

}  // namespace simulate
