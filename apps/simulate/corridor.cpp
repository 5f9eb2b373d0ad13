#include "corridor.hpp"

#include "canvas.hpp"
#include "furniture.hpp"
#include "ground.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace simulate {
namespace {

constexpr double kHalfWidth_m = 1.2;
constexpr double kHeight_m = 2.6;
constexpr double kTexels_per_m = 96;

struct WallStyle {
  Colour wall, skirting;
  bool blank;
};

void paint_door(Canvas& canvas, double x, const Colour& wall, vo::Rng& rng) {
  const double height = canvas.extent_m().height;
  const Colour colour = rng.index(3) == 0
                            ? scaled(wall, 0.8)
                            : hsv({rng.uniform(0, 360), rng.uniform(0.1, 0.6), rng.uniform(0.3, 0.8)});
  const cv::Rect2d door{x, height - 2.05, 0.9, 2.05};
  canvas.fill({door.x - 0.08, door.y - 0.08, 1.06, 2.13}, scaled(colour, 0.55));
  canvas.fill(door, colour);
  canvas.stain(door, {0.15, 1.5}, 0.06, static_cast<std::uint32_t>(rng.bits()));
  if (rng.index(3) == 0) canvas.fill({door.x + 0.3, door.y + 0.2, 0.3, 0.8}, Colour(115, 110, 100));
  const double handle = rng.index(2) == 0 ? 0.08 : 0.78;
  canvas.ellipse({door.x + handle, door.y + 1.05}, {0.035, 0.035}, Colour(210, 215, 215));
  const cv::Rect2d plate{x + 1.02, door.y + 0.5, 0.3, 0.16};
  canvas.fill(plate, Colour(235, 235, 230));
  canvas.text(plate, fmt::format("{}", 100 + rng.index(400)), Colour(30, 25, 25));
}

void paint_board(Canvas& canvas, const cv::Rect2d& board, vo::Rng& rng) {
  canvas.fill({board.x - 0.04, board.y - 0.04, board.width + 0.08, board.height + 0.08}, Colour(70, 85, 100));
  canvas.fill(board, hsv({rng.uniform(0, 360), 0.3, 0.7}));
  for (std::uint64_t i = 3 + rng.index(6); i > 0; --i) {
    const cv::Rect2d sheet{board.x + rng.uniform(0, board.width * 0.75),
                           board.y + rng.uniform(0, board.height * 0.6), 0.21, 0.3};
    canvas.fill(sheet & board, near(Colour(225, 230, 230), 25, rng));
    canvas.clutter(sheet & board, 5, rng);
  }
}

void paint_poster(Canvas& canvas, const cv::Rect2d& poster, vo::Rng& rng) {
  canvas.fill(poster, hsv({rng.uniform(0, 360), rng.uniform(0, 0.6), rng.uniform(0.3, 0.95)}));
  canvas.clutter(poster, 12, rng);
  canvas.text({poster.x, poster.y, poster.width, poster.height * 0.25}, made_up_word(rng),
              Colour(25, 20, 20));
}

Painter wall_painter(double width_m, const WallStyle& style, std::uint64_t seed) {
  return [=](cv::Size texels) {
    vo::Rng rng(seed);
    Canvas canvas(texels, {width_m, kHeight_m}, style.wall);
    const cv::Rect2d all{0, 0, width_m, kHeight_m};
    canvas.stain(all, {3, 2}, 0.03, static_cast<std::uint32_t>(rng.bits()));
    canvas.fill({0, kHeight_m - 0.1, width_m, 0.1}, style.skirting);
    if (style.blank) return canvas.painting();
    for (double x = rng.uniform(0.2, 1.0); x + 1.4 < width_m;) {
      const double room = width_m - x;
      switch (rng.index(5)) {
        case 0:
        case 1:
          paint_door(canvas, x + 0.1, style.wall, rng);
          x += 1.6;
          break;
        case 2: {
          const double width = std::min(rng.uniform(0.9, 1.8), room - 0.3);
          const cv::Rect2d board{x, rng.uniform(0.6, 0.9), width, rng.uniform(0.6, 1.0)};
          paint_board(canvas, board, rng);
          x += width + 0.4;
          break;
        }
        case 3:
          for (std::uint64_t i = 1 + rng.index(3); i > 0; --i) {
            const cv::Rect2d poster{x + rng.uniform(0, 0.6), rng.uniform(0.5, 1.1), rng.uniform(0.3, 0.7),
                                    rng.uniform(0.4, 0.9)};
            paint_poster(canvas, poster, rng);
          }
          x += 1.5;
          break;
        default:  // a switch, a socket, a pipe
          canvas.fill({x, 1.45, 0.09, 0.09}, Colour(235, 235, 235));
          canvas.fill({x + 0.4, 2.25, 0.09, 0.09}, Colour(200, 205, 205));
          if (rng.index(2) == 0)
            canvas.line({x + 0.7, 0}, {x + 0.7, kHeight_m}, 0.06, scaled(style.wall, 0.8));
          x += 1.0;
      }
      x += rng.uniform(0.2, 1.6);
    }
    return canvas.painting();
  };
}

WallStyle draw_style(vo::Rng& rng) {
  const Colour wall = hsv({rng.uniform(0, 360), rng.uniform(0.02, 0.22), rng.uniform(0.72, 0.92)});
  return {wall, scaled(wall, rng.uniform(0.4, 0.7)), false};
}

// One wall from `begin_m` to `end_m` along a leg, in panels of one style each.
void add_wall(const Leg& leg, int side, double begin_m, double end_m, bool blank, vo::Rng& rng,
              WorldBuilder& builder) {
  WallStyle style = draw_style(rng);
  for (double at = begin_m; at < end_m - 1e-6;) {
    double width = rng.uniform(4, 8);
    if (end_m - at - width < 2) width = end_m - at;
    if (rng.index(2) == 0) style = draw_style(rng);
    style.blank = blank;
    const Eigen::Vector2d nearer = leg.at(at, side * kHalfWidth_m),
                          further = leg.at(at + width, side * kHalfWidth_m);
    builder.add_wall(side > 0 ? further : nearer, side > 0 ? nearer : further, 0, kHeight_m, kTexels_per_m,
                     wall_painter(width, style, rng.bits()));
    if (!blank && rng.index(2) == 0) {
      // Chairs turn their back to the wall: their right.
      vo::Pose2 pose = leg.pose(at + width * rng.uniform(0.2, 0.8), side * (kHalfWidth_m - 0.22));
      if (side < 0) pose.heading_rad += 3.14159265358979;
      add_corridor_thing(pose, rng.bits(), builder);
    }
    at += width;
  }
}

void add_side_corridor(const Leg& leg, const SideStreet& side, vo::Rng& rng, WorldBuilder& builder) {
  const double l = side.along_m + side.side * side.width_m / 2;
  const double r = side.along_m - side.side * side.width_m / 2;
  const auto at = [&](double along, double depth) {
    return leg.at(along, side.side * (kHalfWidth_m + depth));
  };
  for (double depth = 0; depth < kSideStreetDepth_m; depth += 6) {
    for (const bool on_left : {true, false}) {
      const Eigen::Vector2d nearer = at(on_left ? l : r, depth), further = at(on_left ? l : r, depth + 6);
      const WallStyle style = draw_style(rng);
      builder.add_wall(on_left ? nearer : further, on_left ? further : nearer, 0, kHeight_m,
                       kTexels_per_m / 3, wall_painter(6, style, rng.bits()));
    }
  }
  const WallStyle style = draw_style(rng);
  builder.add_wall(at(l, kSideStreetDepth_m), at(r, kSideStreetDepth_m), 0, kHeight_m, kTexels_per_m / 3,
                   wall_painter(side.width_m, style, rng.bits()));
}

}  // namespace

void build_corridor(const Route& route, std::uint64_t seed, WorldBuilder& builder) {
  for (const SideStreet& opening : route.side_streets) {
    const Leg leg = route.leg(opening.leg);
    // Every leg has a stream of its own, so that a longer route begins with the shorter one.
    vo::Rng rng(seed * 0x9e3779b97f4a7c15U + opening.leg + 1000);
    const double gap_begin = opening.along_m - opening.width_m / 2,
                 gap_end = opening.along_m + opening.width_m / 2;
    // About one half leg in five is blank on both sides; the first is not, so that a walk begins with
    // something.
    const bool blank_before = leg.index > 0 && rng.index(5) == 0, blank_after = rng.index(5) == 0;
    for (const int side : {-1, 1}) {
      const double right_m = side * kHalfWidth_m;
      const double begin = leg.index == 0 ? -12 : -leg.reach_before_m(right_m);
      const double end = leg.length_m + leg.reach_after_m(right_m);
      const bool open = side == opening.side;
      add_wall(leg, side, begin, open ? gap_begin : opening.along_m, blank_before, rng, builder);
      add_wall(leg, side, open ? gap_end : opening.along_m, end, blank_after, rng, builder);
    }
    add_side_corridor(leg, opening, rng, builder);
    for (double at = rng.uniform(0, 2); at < leg.length_m; at += 5) {
      const Eigen::Vector2d p = leg.at(at, 0);
      builder.add_lamp(
          {{p.x(), p.y(), kHeight_m - 0.1}, cv::Vec3f(0.055F, 0.065F, 0.07F) * rng.uniform(0.3, 1.7)});
    }
  }
  // The walls at both ends.
  const Leg first = route.leg(0), last = route.leg(route.side_streets.size() - 1);
  vo::Rng rng(seed + 5);
  for (const bool at_end : {true, false}) {
    const Leg& leg = at_end ? last : first;
    const double along = at_end ? leg.length_m : -12;
    const Eigen::Vector2d left = leg.at(along, -kHalfWidth_m), right = leg.at(along, kHalfWidth_m);
    const WallStyle style = draw_style(rng);
    builder.add_wall(at_end ? left : right, at_end ? right : left, 0, kHeight_m, kTexels_per_m,
                     wall_painter(2 * kHalfWidth_m, style, rng.bits()));
  }
  add_corridor_floor(route, seed, kHalfWidth_m, kHeight_m, builder);
}

}  // namespace simulate
