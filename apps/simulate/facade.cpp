#include "facade.hpp"

#include "canvas.hpp"
#include "noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace simulate {
namespace {

enum class Material { kPlaster, kBrick, kStone, kPanels, kBoards };

// What the front and the sides of one house share, and its proportions.
struct Style {
  Material material;
  Colour wall, trim, frame;
  double floor_m, ground_floor_m;
  double bay_m;       // one column of windows
  cv::Size2d window;  // as a share of bay and floor
  int panes_across, panes_down;
  bool shutters, sills, arches, shop;
  double lit_share;  // of windows, by night
};

Style draw_facade_style(vo::Rng& rng) {
  struct Tone {
    double hue, saturation, value;
  };
  static constexpr std::array<Tone, 12> kTones{{{12, 0.50, 0.55},
                                                {20, 0.35, 0.70},
                                                {42, 0.38, 0.85},
                                                {40, 0.14, 0.92},
                                                {0, 0.0, 0.62},
                                                {210, 0.12, 0.70},
                                                {95, 0.16, 0.66},
                                                {5, 0.28, 0.80},
                                                {28, 0.45, 0.42},
                                                {200, 0.25, 0.52},
                                                {55, 0.22, 0.74},
                                                {0, 0.0, 0.88}}};
  const Tone& tone = kTones[rng.index(kTones.size())];
  Style style{};
  style.material = static_cast<Material>(rng.index(5));
  style.wall = hsv({tone.hue + rng.uniform(0, 15), tone.saturation * rng.uniform(0.7, 1.3),
                    std::min(1.0, tone.value * rng.uniform(0.85, 1.1))});
  style.trim = rng.index(2) == 0 ? scaled(style.wall, rng.uniform(0.5, 0.75)) : Colour(225, 228, 230);
  style.frame = hsv({rng.uniform(0, 360), rng.uniform(0, 0.5), rng.index(2) == 0 ? 0.92 : 0.3});
  style.floor_m = rng.uniform(2.6, 3.6);
  style.ground_floor_m = rng.uniform(2.9, 4.2);
  style.bay_m = rng.uniform(1.5, 3.4);
  style.window = {rng.uniform(0.35, 0.72), rng.uniform(0.40, 0.68)};
  style.panes_across = 1 + static_cast<int>(rng.index(3));
  style.panes_down = 1 + static_cast<int>(rng.index(3));
  style.shutters = rng.index(4) == 0;
  style.sills = rng.index(3) != 0;
  style.arches = rng.index(4) == 0;
  style.shop = rng.index(2) == 0;
  style.lit_share = rng.uniform(0.1, 0.5);
  return style;
}

// Courses of bricks, stones, panels or boards, each piece with its own tint, with dark joints.
void lay_courses(Canvas& canvas, const Style& style, vo::Rng& rng) {
  const cv::Size2d extent = canvas.extent_m();
  double width = 0, height = 0, joint = 0.025, tint = 18;
  switch (style.material) {
    case Material::kPlaster:
      return;
    case Material::kBrick:
      width = rng.uniform(0.24, 0.36), height = rng.uniform(0.11, 0.16);
      break;
    case Material::kStone:
      width = rng.uniform(0.5, 1.1), height = rng.uniform(0.28, 0.5);
      break;
    case Material::kPanels:
      width = rng.uniform(1.0, 2.4), height = rng.uniform(0.8, 1.6), tint = 8;
      break;
    case Material::kBoards:
      width = extent.width, height = rng.uniform(0.14, 0.25), tint = 10;
      break;
  }
  canvas.fill({0, 0, extent.width, extent.height}, scaled(style.wall, 0.66));
  bool odd = false;
  for (double y = 0; y < extent.height; y += height, odd = !odd) {
    for (double x = odd ? -width / 2 : 0; x < extent.width; x += width) {
      canvas.fill({x, y, width - joint, height - joint}, near(style.wall, tint, rng));
    }
  }
}

void paint_window(Canvas& canvas, const cv::Rect2d& window, const Style& style, vo::Rng& rng) {
  const double border = 0.07;
  canvas.fill({window.x - border, window.y - border, window.width + 2 * border, window.height + 2 * border},
              style.trim);
  if (style.arches) {
    canvas.ellipse({window.x + window.width / 2, window.y}, {window.width / 2, window.height * 0.15},
                   style.trim);
  }
  canvas.fill(window, style.frame);
  const Colour glass = near(Colour(70, 58, 50), 22, rng);
  const double pane_w = window.width / style.panes_across, pane_h = window.height / style.panes_down;
  for (int i = 0; i < style.panes_across; ++i) {
    for (int j = 0; j < style.panes_down; ++j) {
      const cv::Rect2d pane{window.x + i * pane_w + 0.03, window.y + j * pane_h + 0.03, pane_w - 0.06,
                            pane_h - 0.06};
      canvas.fill(pane, near(glass, 10, rng));
    }
  }
  switch (rng.index(6)) {
    case 0: {  // a blind, drawn some way
      const double drawn = rng.uniform(0.2, 0.9);
      canvas.fill({window.x, window.y, window.width, window.height * drawn},
                  near(Colour(170, 190, 200), 40, rng));
      break;
    }
    case 1: {  // curtains
      const double share = rng.uniform(0.15, 0.4);
      canvas.fill({window.x, window.y, window.width * share, window.height},
                  hsv({rng.uniform(0, 360), 0.4, rng.uniform(0.4, 0.9)}));
      canvas.fill({window.x + window.width * 0.7, window.y, window.width * 0.3, window.height},
                  hsv({rng.uniform(0, 360), 0.4, rng.uniform(0.4, 0.9)}));
      break;
    }
    case 2:  // plants and things on the sill
      canvas.clutter({window.x, window.y + window.height * 0.6, window.width, window.height * 0.4}, 6, rng);
      break;
    case 3: {  // the sky in the glass
      const cv::Point2d left{window.x, window.y + window.height * rng.uniform(0.3, 1)};
      const cv::Point2d right{window.x + window.width, window.y + window.height * rng.uniform(0, 0.6)};
      canvas.line(left, right, 0.12, Colour(190, 170, 150));
      break;
    }
    default:
      break;
  }
  if (style.sills) {
    canvas.fill({window.x - 0.12, window.br().y, window.width + 0.24, 0.1}, scaled(style.trim, 0.85));
  }
  if (style.shutters) {
    const Colour colour = near(style.frame, 12, rng);
    canvas.fill({window.x - 0.4, window.y, 0.36, window.height}, colour);
    canvas.fill({window.br().x + 0.04, window.y, 0.36, window.height}, colour);
  }
  if (rng.uniform() < style.lit_share) canvas.glow(window, Colour(60, 130, 190) * rng.uniform(0.3, 0.9));
}

void paint_windows(Canvas& canvas, const Style& style, double omit_share, vo::Rng& rng) {
  const cv::Size2d extent = canvas.extent_m();
  const int bays = std::max(1, static_cast<int>(extent.width / style.bay_m));
  const double bay = extent.width / bays;
  const double width = bay * style.window.width, height = style.floor_m * style.window.height;
  for (double floor = extent.height - style.ground_floor_m - style.floor_m; floor > 0.2;
       floor -= style.floor_m) {
    for (int i = 0; i < bays; ++i) {
      if (rng.uniform() < omit_share) continue;
      const double x = i * bay + (bay - width) / 2 + rng.uniform(-0.08, 0.08);
      paint_window(canvas, {x, floor + (style.floor_m - height) * 0.45, width, height}, style, rng);
    }
    if (rng.index(3) == 0) canvas.fill({0, floor + style.floor_m - 0.15, extent.width, 0.12}, style.trim);
  }
}

void paint_sign(Canvas& canvas, const cv::Rect2d& area, vo::Rng& rng) {
  const double hue = rng.uniform(0, 360);
  const bool dark = rng.index(2) == 0;
  canvas.fill(area, hsv({hue, rng.uniform(0.3, 0.9), dark ? 0.35 : 0.9}));
  canvas.text(area, made_up_word(rng), dark ? Colour(235, 240, 240) : Colour(30, 25, 20));
  if (rng.index(2) == 0) canvas.glow(area, Colour(120, 150, 170) * rng.uniform(0.5, 1.0));
}

void paint_shop(Canvas& canvas, const cv::Rect2d& area, const Style& style, vo::Rng& rng) {
  const Colour frame = hsv({rng.uniform(0, 360), rng.uniform(0.2, 0.8), rng.uniform(0.25, 0.7)});
  canvas.fill(area, frame);
  const double sign_m = 0.6;
  paint_sign(canvas, {area.x + 0.1, area.y + 0.08, area.width - 0.2, sign_m}, rng);
  const cv::Rect2d window{area.x + 0.15, area.y + sign_m + 0.2, area.width - 1.35,
                          area.height - sign_m - 0.7};
  canvas.fill(window, near(Colour(80, 75, 70), 20, rng));
  canvas.clutter({window.x, window.y + window.height * 0.35, window.width, window.height * 0.65}, 26, rng);
  for (double x = window.x; x < window.br().x; x += 1.3)
    canvas.fill({x, window.y, 0.06, window.height}, frame);
  const cv::Rect2d door{window.br().x + 0.15, window.y, 0.9, area.height - sign_m - 0.25};
  canvas.fill(door, scaled(frame, 0.6));
  canvas.fill({door.x + 0.12, door.y + 0.15, 0.66, door.height - 0.5}, near(Colour(90, 80, 75), 15, rng));
  if (rng.index(2) == 0) {  // a striped awning over the window
    const Colour stripe = hsv({rng.uniform(0, 360), 0.7, 0.75});
    int i = 0;
    for (double x = area.x; x < window.br().x; x += 0.3) {
      canvas.fill({x, window.y - 0.1, 0.3, 0.5}, ++i % 2 == 0 ? stripe : Colour(225, 230, 230));
    }
  }
  if (rng.uniform() < style.lit_share + 0.3)
    canvas.glow(window, Colour(110, 160, 200) * rng.uniform(0.4, 0.9));
}

void paint_door(Canvas& canvas, const cv::Rect2d& area, const Style& style, vo::Rng& rng) {
  const Colour colour = hsv({rng.uniform(0, 360), rng.uniform(0.3, 0.8), rng.uniform(0.2, 0.7)});
  const cv::Rect2d door{area.x + area.width / 2 - 0.5, area.br().y - 2.2, 1.0, 2.2};
  canvas.fill({door.x - 0.15, door.y - 0.2, 1.3, 2.4}, style.trim);
  canvas.fill(door, colour);
  for (const double y : {0.2, 1.2}) {
    canvas.fill({door.x + 0.12, door.y + y, 0.32, 0.75}, scaled(colour, 0.7));
    canvas.fill({door.x + 0.56, door.y + y, 0.32, 0.75}, scaled(colour, 0.7));
  }
  canvas.text({door.x + 1.2, door.y + 0.3, 0.5, 0.3}, fmt::format("{}", 1 + rng.index(199)),
              Colour(20, 20, 20));
  canvas.glow({door.x, door.y - 0.2, 1.0, 0.2}, Colour(90, 150, 190));
}

void paint_ground_floor(Canvas& canvas, const Style& style, vo::Rng& rng) {
  const cv::Size2d extent = canvas.extent_m();
  const double top = extent.height - style.ground_floor_m;
  if (rng.index(2) == 0) {
    canvas.fill({0, top, extent.width, style.ground_floor_m}, near(scaled(style.wall, 0.8), 25, rng));
  }
  for (double x = 0.2; x + 2.4 < extent.width;) {
    const double width = std::min(rng.uniform(2.4, 5.5), extent.width - x - 0.2);
    const cv::Rect2d part{x, top + 0.15, width, style.ground_floor_m - 0.15};
    const std::uint64_t kind = rng.index(5);
    if (style.shop && kind != 0) {
      paint_shop(canvas, part, style, rng);
    } else if (kind <= 1) {
      paint_door(canvas, part, style, rng);
    } else if (kind == 2) {  // a garage or a gate
      const Colour colour = near(Colour(120, 125, 130), 50, rng);
      for (double y = 0.5; y < part.height - 0.1; y += 0.25) {
        canvas.fill({part.x + 0.2, part.y + y, part.width - 0.4, 0.22}, near(colour, 10, rng));
      }
    } else {
      const double w = width * rng.uniform(0.4, 0.7);
      paint_window(canvas, {part.x + (width - w) / 2, part.y + 0.6, w, part.height - 1.7}, style, rng);
    }
    x += width + rng.uniform(0.1, 0.8);
  }
  canvas.fill({0, extent.height - rng.uniform(0.2, 0.5), extent.width, 0.5}, scaled(style.wall, 0.55));
}

// What hangs on a wall: a cornice, drainpipes, a sign higher up, posters, boxes, scribbles.
void paint_fittings(Canvas& canvas, const Style& style, vo::Rng& rng) {
  const cv::Size2d extent = canvas.extent_m();
  canvas.fill({0, 0, extent.width, rng.uniform(0.15, 0.4)}, scaled(style.trim, 0.8));
  for (std::uint64_t i = rng.index(3); i > 0; --i) {
    const double x = extent.width * rng.uniform(0.02, 0.98);
    canvas.line({x, 0}, {x, extent.height}, 0.1, near(Colour(95, 100, 105), 40, rng));
  }
  if (rng.index(3) == 0) {
    const double x = rng.uniform(0, extent.width * 0.5);
    const double width = extent.width * rng.uniform(0.25, 0.45);
    paint_sign(canvas, {x, extent.height - style.ground_floor_m - 0.9, width, 0.7}, rng);
  }
  for (std::uint64_t i = rng.index(4); i > 0; --i) {
    const cv::Rect2d poster{extent.width * rng.uniform(0, 0.85), extent.height - rng.uniform(1.3, 2.2),
                            rng.uniform(0.4, 0.9), rng.uniform(0.5, 1.0)};
    canvas.fill(poster, hsv({rng.uniform(0, 360), rng.uniform(0, 0.6), rng.uniform(0.5, 0.95)}));
    canvas.clutter(poster, 9, rng);
  }
  if (rng.index(4) == 0) {
    const Colour paint = hsv({rng.uniform(0, 360), 0.8, rng.uniform(0.2, 0.9)});
    cv::Point2d at{extent.width * rng.uniform(0.05, 0.95), extent.height - rng.uniform(0.5, 1.6)};
    for (int i = 0; i < 12; ++i) {
      const cv::Point2d to = at + cv::Point2d{rng.uniform(-0.2, 0.4), rng.uniform(-0.4, 0.4)};
      canvas.line(at, to, 0.06, paint);
      at = to;
    }
  }
}

Painting paint_house(cv::Size texels, cv::Size2d extent, std::uint64_t seed, bool front) {
  vo::Rng rng(seed);
  const Style style = draw_facade_style(rng);
  vo::Rng details = front ? rng.split() : vo::Rng(seed + 1).split();
  const cv::Rect2d all{0, 0, extent.width, extent.height};
  Canvas canvas(texels, extent, style.wall);
  lay_courses(canvas, style, details);
  canvas.stain(all, {4, 3}, 0.16, static_cast<std::uint32_t>(details.bits()));
  if (front) {
    paint_windows(canvas, style, 0.04, details);
    paint_ground_floor(canvas, style, details);
    paint_fittings(canvas, style, details);
  } else {
    paint_windows(canvas, style, 0.6, details);
  }
  // Rain runs down walls: streaks longer than they are wide, and grain in everything.
  canvas.stain(all, {0.5, 4}, 0.09, static_cast<std::uint32_t>(details.bits()));
  return canvas.painting();
}

}  // namespace

Painter facade_painter(cv::Size2d extent_m, std::uint64_t seed) {
  return [=](cv::Size texels) { return paint_house(texels, extent_m, seed, true); };
}

Painter side_wall_painter(cv::Size2d extent_m, std::uint64_t seed) {
  return [=](cv::Size texels) { return paint_house(texels, extent_m, seed, false); };
}

}  // namespace simulate
