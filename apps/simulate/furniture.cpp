#include "furniture.hpp"

#include "canvas.hpp"
#include "path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace simulate {
namespace {

constexpr double kFurnitureTexels_per_m = 48;

// A surface of one colour with stains; good for posts, trunks and tops.
Painter plain_painter(const Colour& colour, double stains, std::uint64_t seed) {
  return [=](cv::Size texels) {
    Canvas canvas(texels, {texels.width / kFurnitureTexels_per_m, texels.height / kFurnitureTexels_per_m},
                  colour);
    canvas.stain({0, 0, 1e3, 1e3}, {0.4, 0.8}, stains, static_cast<std::uint32_t>(seed));
    return canvas.painting();
  };
}

// Leaves: blobs of many greens, darker below, cut out around the edge.
Painter foliage_painter(cv::Size2d extent_m, double hue, std::uint64_t seed) {
  return [=](cv::Size texels) {
    vo::Rng rng(seed);
    Canvas canvas(texels, extent_m, hsv({hue, 0.5, 0.3}));
    Painting& painting = canvas.painting();
    painting.alpha = cv::Mat1b::zeros(texels);
    const double leaf = kFurnitureTexels_per_m * 0.09;
    const int leaves = static_cast<int>(70 * extent_m.area());
    for (int i = 0; i < leaves; ++i) {
      const double angle = rng.uniform(0, 2 * std::numbers::pi), radius = std::sqrt(rng.uniform());
      const double x = 0.5 + 0.44 * radius * std::cos(angle), y = 0.5 + 0.44 * radius * std::sin(angle);
      const cv::Point at(static_cast<int>(x * texels.width), static_cast<int>(y * texels.height));
      const cv::Size size{1 + static_cast<int>(leaf * rng.uniform(0.4, 1.8)),
                          1 + static_cast<int>(leaf * rng.uniform(0.4, 1.5))};
      const double value = (0.62 - 0.34 * y) * rng.uniform(0.55, 1.35);
      const double turn_deg = rng.uniform(0, 180);
      cv::ellipse(painting.colour, at, size, turn_deg, 0, 360,
                  hsv({hue + rng.uniform(-18, 18), rng.uniform(0.35, 0.7), value}), cv::FILLED, cv::LINE_AA);
      cv::ellipse(painting.alpha, at, size, turn_deg, 0, 360, 255, cv::FILLED);
    }
    return painting;
  };
}

// Upright sheets of leaves through one axis, 60 degrees apart: they look full from every side.
void add_foliage(const vo::Pose2& pose, double radius_m, double bottom_m, double top_m, vo::Rng& rng,
                 WorldBuilder& builder) {
  const double hue = rng.uniform(70, 125);
  for (int i = 0; i < 3; ++i) {
    const double angle = pose.heading_rad + 0.3 + i * std::numbers::pi / 3;
    const Eigen::Vector2d half = Eigen::Vector2d(std::cos(angle), -std::sin(angle)) * radius_m;
    const Eigen::Vector2d middle(pose.x_m, pose.y_m);
    builder.add_wall(middle - half, middle + half, bottom_m, top_m, kFurnitureTexels_per_m,
                     foliage_painter({2 * radius_m, top_m - bottom_m}, hue, rng.bits()));
  }
}

Painter car_painter(WorldBuilder::Face face, cv::Size2d extent_m, const Colour& body, bool cabin,
                    std::uint64_t seed) {
  return [=](cv::Size texels) {
    vo::Rng rng(seed);
    Canvas canvas(texels, extent_m, body);
    const double w = extent_m.width, h = extent_m.height;
    const Colour glass(75, 62, 52), black(28, 26, 25);
    if (face == WorldBuilder::Face::kTop) {
      if (!cabin) canvas.line({0, h * 0.3}, {w, h * 0.3}, 0.04, scaled(body, 0.6));
    } else if (cabin) {
      canvas.fill({0.1, 0.08, w - 0.2, h - 0.16}, glass);
      if (face == WorldBuilder::Face::kSide) canvas.fill({w * 0.48, 0, 0.1, h}, body);
      canvas.line({0.1, h * 0.8}, {w - 0.1, h * 0.3}, 0.1, Colour(150, 138, 125));
    } else if (face == WorldBuilder::Face::kSide) {
      canvas.fill({0, h - 0.14, w, 0.14}, black);
      for (const double at : {0.2, 0.8}) {
        canvas.ellipse({w * at, h - 0.18}, {0.36, 0.36}, black);
        canvas.ellipse({w * at, h - 0.14}, {0.19, 0.19}, Colour(160, 160, 158));
      }
      canvas.line({w * 0.5, 0}, {w * 0.5, h - 0.15}, 0.03, scaled(body, 0.5));
      canvas.line({0, h * 0.4}, {w, h * 0.4}, 0.04, scaled(body, 1.3));
      canvas.fill({w * 0.54, h * 0.25, 0.2, 0.06}, black);
    } else {
      canvas.fill({0, h - 0.2, w, 0.2}, black);
      for (const double at : {0.05, w - 0.4})
        canvas.fill({at, h * 0.2, 0.35, 0.16},
                    rng.index(2) == 0 ? Colour(40, 40, 190) : Colour(220, 230, 235));
      const cv::Rect2d plate{w / 2 - 0.27, h * 0.52, 0.54, 0.14};
      canvas.fill(plate, Colour(225, 230, 230));
      canvas.text(plate, made_up_word(rng), black);
    }
    canvas.stain({0, 0, w, h}, {0.8, 0.5}, 0.08, static_cast<std::uint32_t>(seed));
    return canvas.painting();
  };
}

// A box with things painted on it: writing, shapes, dirt.
void add_painted_box(const WorldBuilder::Box& box, const Colour& colour, int shapes, bool writing,
                     vo::Rng& rng, WorldBuilder& builder) {
  builder.add_box(box, kFurnitureTexels_per_m, [&](WorldBuilder::Face face) -> Painter {
    const double width = face == WorldBuilder::Face::kEnd ? box.width_m : box.length_m;
    const cv::Size2d extent{face == WorldBuilder::Face::kTop ? box.width_m : width,
                            face == WorldBuilder::Face::kTop ? box.length_m : box.top_m - box.bottom_m};
    const std::uint64_t seed = rng.bits();
    return [=](cv::Size texels) {
      vo::Rng own(seed);
      Canvas canvas(texels, extent, colour);
      canvas.fill({0, 0, extent.width, 0.05}, scaled(colour, 0.6));
      if (face != WorldBuilder::Face::kTop) {
        canvas.clutter({0.05, 0.08, extent.width - 0.1, extent.height - 0.15}, shapes, own);
        if (writing)
          canvas.text({0, extent.height * 0.1, extent.width, extent.height * 0.4}, made_up_word(own),
                      Colour(20, 20, 25));
      }
      canvas.stain({0, 0, extent.width, extent.height}, {0.4, 0.4}, 0.16, static_cast<std::uint32_t>(seed));
      return canvas.painting();
    };
  });
}

}  // namespace

void add_tree(const vo::Pose2& pose, const TreeSize& size, std::uint64_t seed, WorldBuilder& builder) {
  const auto [crown_radius_m, trunk_m] = size;
  vo::Rng rng(seed);
  const double thickness = rng.uniform(0.16, 0.3);
  const Colour brown = near(Colour(60, 75, 90), 20, rng);
  const Painter bark = plain_painter(brown, 0.35, rng.bits());
  builder.add_box({pose, thickness, thickness, 0, trunk_m + 0.6 * crown_radius_m}, kFurnitureTexels_per_m,
                  [&](WorldBuilder::Face) { return bark; });
  add_foliage(pose, crown_radius_m, trunk_m, trunk_m + 2.2 * crown_radius_m, rng, builder);
}

void add_car(const vo::Pose2& pose, std::uint64_t seed, WorldBuilder& builder) {
  vo::Rng rng(seed);
  const Colour body =
      hsv({rng.uniform(0, 360), rng.index(2) == 0 ? rng.uniform(0, 0.15) : rng.uniform(0.3, 0.65),
           rng.uniform(0.2, 0.9)});
  const bool van = rng.index(6) == 0;
  const double length = rng.uniform(3.7, 4.7), width = rng.uniform(1.65, 1.8), waist = rng.uniform(0.8, 0.95);
  const double roof = van ? rng.uniform(1.9, 2.2) : rng.uniform(1.38, 1.5);
  const double cabin = van ? length * 0.95 : length * rng.uniform(0.5, 0.62);
  const auto add = [&](const WorldBuilder::Box& box, bool is_cabin) {
    builder.add_box(box, kFurnitureTexels_per_m, [&](WorldBuilder::Face face) {
      const double across = face == WorldBuilder::Face::kSide ? box.length_m : box.width_m;
      const double down = face == WorldBuilder::Face::kTop ? box.length_m : box.top_m - box.bottom_m;
      return car_painter(face, {across, down}, body, is_cabin, rng.bits());
    });
  };
  add({pose, length, width, 0.1, waist}, false);
  add({pose, cabin, width * 0.92, waist, roof}, true);
}

void add_street_lamp(const vo::Pose2& pose, double height_m, const cv::Vec3f& bgr, std::uint64_t seed,
                     WorldBuilder& builder) {
  const Painter metal = plain_painter(Colour(70, 72, 70), 0.25, seed);
  builder.add_box({pose, 0.12, 0.12, 0, height_m}, kFurnitureTexels_per_m,
                  [&](WorldBuilder::Face) { return metal; });
  const Painter head = [](cv::Size texels) {
    Canvas canvas(texels, {0.4, 0.3}, Colour(200, 205, 205));
    canvas.glow({0, 0.06, 0.4, 0.24}, Colour(190, 235, 255));
    return canvas.painting();
  };
  builder.add_box({pose, 0.4, 0.4, height_m, height_m + 0.3}, kFurnitureTexels_per_m,
                  [&](WorldBuilder::Face) { return head; });
  builder.add_lamp({{pose.x_m, pose.y_m, height_m}, bgr});
}

void add_street_thing(const vo::Pose2& pose, std::uint64_t seed, WorldBuilder& builder) {
  vo::Rng rng(seed);
  const Colour colour = hsv({rng.uniform(0, 360), rng.uniform(0.1, 0.8), rng.uniform(0.25, 0.85)});
  switch (rng.index(5)) {
    case 0:
      add_painted_box({pose, 0.45, 0.45, 0, 0.95}, colour, 4, true, rng, builder);
      break;  // a bin
    case 1:   // a bench
      add_painted_box({pose, 1.7, 0.45, 0.35, 0.48}, Colour(55, 85, 115), 0, false, rng, builder);
      add_painted_box({moved_right(pose, 0.2), 1.7, 0.06, 0.48, 0.9}, Colour(55, 85, 115), 0, false, rng,
                      builder);
      break;
    case 2:  // bollards
      for (const double at : {-0.8, 0.0, 0.8}) {
        const vo::Pose2 p{pose.x_m + at * std::sin(pose.heading_rad),
                          pose.y_m + at * std::cos(pose.heading_rad), pose.heading_rad};
        add_painted_box({p, 0.16, 0.16, 0, 0.9}, Colour(190, 190, 195), 2, false, rng, builder);
      }
      break;
    case 3:
      add_painted_box({pose, 1.0, 0.35, 0, 1.3}, Colour(140, 150, 140), 14, false, rng, builder);
      break;  // a box
    default:
      add_painted_box({pose, 0.12, 0.75, 0.1, 1.15}, colour, 8, true, rng, builder);  // a board
  }
}

void add_corridor_thing(const vo::Pose2& pose, std::uint64_t seed, WorldBuilder& builder) {
  vo::Rng rng(seed);
  const Colour colour = hsv({rng.uniform(0, 360), rng.uniform(0, 0.4), rng.uniform(0.35, 0.85)});
  switch (rng.index(4)) {
    case 0: {
      const WorldBuilder::Box cupboard{pose, rng.uniform(0.6, 1.4), 0.35, 0, rng.uniform(1.2, 1.9)};
      add_painted_box(cupboard, colour, 3, false, rng, builder);
      break;
    }
    case 1:
      add_painted_box({pose, 0.35, 0.35, 0, 0.6}, colour, 1, true, rng, builder);
      break;
    case 2:
      add_painted_box({pose, 0.45, 0.4, 0.38, 0.46}, colour, 0, false, rng, builder);
      add_painted_box({moved_right(pose, 0.18), 0.45, 0.04, 0.46, 0.9}, colour, 0, false, rng, builder);
      break;
    default:
      add_painted_box({pose, 0.3, 0.3, 0, 0.35}, colour, 0, false, rng, builder);
      add_foliage(pose, 0.3, 0.35, 1.2, rng, builder);
  }
}

void add_garden(const vo::Pose2& pose, double width_m, std::uint64_t seed, WorldBuilder& builder) {
  vo::Rng rng(seed);
  const Colour green = hsv({rng.uniform(80, 120), 0.5, 0.35});
  const Painter hedge = plain_painter(green, 0.5, rng.bits());
  builder.add_box({pose, width_m, 0.6, 0, rng.uniform(0.7, 1.4)}, kFurnitureTexels_per_m,
                  [&](WorldBuilder::Face) { return hedge; });
  const TreeSize size{rng.uniform(1.2, 2.2), rng.uniform(1.2, 2.2)};
  add_tree(pose, size, rng.bits(), builder);
}

}  // namespace simulate
