#include "ground.hpp"

#include "canvas.hpp"
#include "noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

namespace simulate {
namespace {

// A stretch of straight centre line: a leg of the route or of a side street.
struct Line {
  std::uint32_t id;
  Eigen::Vector2d begin, along;
  double length_m;
};

// A point of the ground as seen from the nearest line: how far along and how far to the right of it.
struct Place {
  std::uint32_t line;
  double along_m;
  double right_m;
};

using Lines = std::vector<Line>;
// The colour at a point, given its place and how worn it is, around 1.
using GroundColour = std::function<cv::Vec3f(const Eigen::Vector2d&, const Place&, float wear)>;

Lines route_lines(const Route& route, bool with_side_streets) {
  Lines lines;
  for (std::size_t i = 0; i + 1 < route.corners.size(); ++i) {
    const Eigen::Vector2d leg = route.corners[i + 1] - route.corners[i];
    const Eigen::Vector2d along = leg.normalized();
    const double before_m = i == 0 ? 15 : 0;  // one may look back, and step off the first metre
    lines.push_back(
        {static_cast<std::uint32_t>(i), route.corners[i] - before_m * along, along, leg.norm() + before_m});
  }
  if (!with_side_streets) return lines;
  for (const SideStreet& street : route.side_streets) {
    const Eigen::Vector2d along = lines[street.leg].along;
    const Eigen::Vector2d off = street.side * Eigen::Vector2d(along.y(), -along.x());
    lines.push_back({static_cast<std::uint32_t>(street.leg) + 100000U,
                     route.corners[street.leg] + along * street.along_m, off, kSideStreetDepth_m + 3});
  }
  return lines;
}

Place locate(const Eigen::Vector2d& point, const Lines& lines) {
  Place best{0, 0, 1e9};
  for (const Line& line : lines) {
    const Eigen::Vector2d to = point - line.begin;
    const double along = std::clamp(to.dot(line.along), 0.0, line.length_m);
    const double distance = (to - line.along * along).norm();
    if (distance >= std::abs(best.right_m)) continue;
    const double right = to.x() * line.along.y() - to.y() * line.along.x();
    best = {line.id, along, right < 0 ? -distance : distance};
  }
  return best;
}

struct Sheet {
  double cell_m, height_m, reach_m;
  bool facing_up;
  double wear_m;  // the size of the largest stains
  float wear;     // how strong they are
  std::uint32_t seed;
  std::function<double(double)> texels_per_m;  // by distance from the line
};

// Covers what is within reach of the lines with square cells on a grid of the world.
void add_sheet(const Sheet& sheet, const Lines& lines, const GroundColour& colour, WorldBuilder& builder) {
  std::set<std::pair<int, int>> cells;
  const double reach = sheet.reach_m + sheet.cell_m * 0.71;
  for (const Line& line : lines) {
    const int steps = static_cast<int>(reach / sheet.cell_m) + 1;
    for (double s = 0; s <= line.length_m; s += sheet.cell_m / 2) {
      const Eigen::Vector2d p = line.begin + line.along * s;
      const int cx = static_cast<int>(std::floor(p.x() / sheet.cell_m));
      const int cy = static_cast<int>(std::floor(p.y() / sheet.cell_m));
      for (int y = cy - steps; y <= cy + steps; ++y) {
        for (int x = cx - steps; x <= cx + steps; ++x) cells.insert({x, y});
      }
    }
  }
  for (const auto& [cx, cy] : cells) {
    const double cell = sheet.cell_m;
    const Eigen::Vector2d centre((cx + 0.5) * cell, (cy + 0.5) * cell);
    const double distance = std::abs(locate(centre, lines).right_m);
    if (distance > reach) continue;
    Lines nearby;
    std::ranges::copy_if(lines, std::back_inserter(nearby), [&](const Line& line) {
      return std::abs(locate(centre, {line}).right_m) < distance + 2 * cell;
    });
    const Eigen::Vector2d west_north(cx * cell, (cy + 1) * cell);
    const auto paint = [=](cv::Size texels) {
      Painting painting;
      painting.colour.create(texels);
      const double scale = texels.width / cell;
      const cv::Mat1f wear = fractal_image(texels, {sheet.wear_m * scale, sheet.wear_m * scale}, sheet.seed,
                                           {west_north.x() * scale, -west_north.y() * scale});
      for (int y = 0; y < texels.height; ++y) {
        for (int x = 0; x < texels.width; ++x) {
          const Eigen::Vector2d point = west_north + Eigen::Vector2d((x + 0.5) / texels.width * cell,
                                                                     -(y + 0.5) / texels.height * cell);
          const cv::Vec3f bgr = colour(point, locate(point, nearby), 1 + sheet.wear * wear(y, x));
          for (int c = 0; c < 3; ++c) painting.colour(y, x)[c] = cv::saturate_cast<std::uint8_t>(bgr[c]);
        }
      }
      if (!sheet.facing_up) cv::flip(painting.colour, painting.colour, 0);
      return painting;
    };
    const double texels = sheet.texels_per_m(std::max(0.0, distance - cell * 0.71));
    if (sheet.facing_up) {
      builder.add({west_north.x(), west_north.y(), sheet.height_m}, {cell, 0, 0}, {0, -cell, 0}, texels,
                  paint);
    } else {
      builder.add({west_north.x(), west_north.y() - cell, sheet.height_m}, {cell, 0, 0}, {0, cell, 0}, texels,
                  paint);
    }
  }
}

float grain(const Eigen::Vector2d& p, double feature_m, int octaves, std::uint32_t seed) {
  return fractal_noise(static_cast<float>(p.x() / feature_m), static_cast<float>(p.y() / feature_m), octaves,
                       seed);
}

// Slabs or setts: a grid with joints, each piece with a tint of its own.
float paving(double along, double right, double length_m, double width_m, double joint_m,
             std::uint32_t seed) {
  const double row = std::floor(right / width_m);
  const double shifted = along + (static_cast<int>(row) % 2 == 0 ? 0 : length_m / 2);
  const double column = std::floor(shifted / length_m);
  const double dx = shifted - column * length_m, dy = right - row * width_m;
  if (dx < joint_m || dy < joint_m) return 0.6F;
  return 0.86F + 0.28F * lattice_uniform(static_cast<int>(column), static_cast<int>(row), seed);
}

cv::Vec3f tone(std::uint32_t id, std::uint32_t seed, std::uint32_t salt) {
  const auto u = [&](std::int32_t k) {
    return lattice_uniform(static_cast<std::int32_t>(id), k, seed + salt);
  };
  const Colour c = hsv({20 + 40 * u(0), 0.04 + 0.18 * u(1), 0.48 + 0.25 * u(2)});
  return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
}

cv::Vec3f street_colour(const Eigen::Vector2d& p, const Place& place, float wear, int near_side,
                        std::uint32_t seed) {
  const double b = place.right_m * near_side;
  const auto u = [&](std::int32_t k) {
    return lattice_uniform(static_cast<std::int32_t>(place.line), k, seed);
  };
  if (place.line >= 100000U) {  // setts in side streets
    return tone(place.line, seed, 7) * (wear * paving(place.along_m, place.right_m, 0.22, 0.16, 0.02, seed));
  }
  if (b > -2.0) {
    const double slab = 0.4 + 0.5 * u(3);
    cv::Vec3f c = tone(place.line, seed, 1) *
                  (wear * paving(place.along_m, b, slab, 0.3 + 0.4 * u(4), 0.02, seed + place.line));
    // Spots of chewing gum, leaves, puddle stains.
    const int sx = static_cast<int>(std::floor(p.x() * 4)), sy = static_cast<int>(std::floor(p.y() * 4));
    const float kind = lattice_uniform(sx, sy, seed + 11);
    const Eigen::Vector2d centre((sx + 0.3 + 0.4 * lattice_uniform(sx, sy, seed + 12)) / 4,
                                 (sy + 0.3 + 0.4 * lattice_uniform(sx, sy, seed + 13)) / 4);
    if (kind < 0.25F && (p - centre).norm() < 0.015 + 0.2 * kind) {
      c = kind < 0.09F ? cv::Vec3f(40, 110, 150) : kind < 0.17F ? c * 0.45F : c * 1.35F;
    }
    return c;
  }
  if (b > -2.15 || (b > -9.15 && b <= -9.0)) {
    return cv::Vec3f(165, 170, 172) * (wear * (std::fmod(place.along_m, 1.0) < 0.03 ? 0.6F : 1.0F));
  }
  if (b > -9.0) {  // asphalt, mended here and there, with a broken line
    if (std::abs(b + 5.6) < 0.07 && std::fmod(place.along_m, 6.0) < 3.0)
      return cv::Vec3f(205, 208, 210) * wear;
    const float mended = grain(p, 5.0, 2, seed + 5) > 0.25F ? 0.72F : 1.0F;
    const float crack = std::abs(grain(p, 2.0, 3, seed + 6)) < 0.012F ? 0.55F : 1.0F;
    return cv::Vec3f(98, 95, 93) * (wear * mended * crack);
  }
  if (b > -11.9) return tone(place.line, seed, 2) * (wear * paving(place.along_m, b, 0.6, 0.6, 0.03, seed));
  return cv::Vec3f(60, 105, 98) * (2 * wear - 1);  // grass: twice the stains
}

cv::Vec3f floor_colour(const Eigen::Vector2d& p, const Place& place, float wear, std::uint32_t seed) {
  const auto u = [&](std::int32_t k) {
    return lattice_uniform(static_cast<std::int32_t>(place.line), k, seed);
  };
  cv::Vec3f c = tone(place.line, seed, 3) * (0.85F + 0.4F * u(1));
  if (u(2) < 0.4F) {  // tiles
    c *= paving(place.along_m, place.right_m, 0.6, 0.6, 0.012, seed + place.line);
  } else {  // speckled linoleum
    const float speck = lattice_uniform(static_cast<int>(std::floor(p.x() * 50)),
                                        static_cast<int>(std::floor(p.y() * 50)), seed + 3);
    c *= speck < 0.06F ? 0.75F : speck > 0.95F ? 1.2F : 1.0F;
  }
  if (std::abs(place.right_m) > 1.05) c *= 0.6F;
  return c * wear;
}

cv::Vec3f ceiling_colour(const Place& place, std::uint32_t seed) {
  // Panels of 0.6 m; every fifth in the middle is a light.
  const bool middle = std::abs(place.right_m) < 0.3;
  const double cell = std::floor(place.along_m / 0.6);
  if (middle && static_cast<int>(cell) % 5 == 2) return {250, 252, 252};
  return cv::Vec3f(205, 210, 212) * paving(place.along_m, place.right_m + 0.3, 0.6, 0.6, 0.02, seed) * 0.95F;
}

}  // namespace

void add_street_ground(const Route& route, std::uint64_t seed, Condition condition, WorldBuilder& builder) {
  const auto seed32 = static_cast<std::uint32_t>(seed ^ (seed >> 32U)) * 2654435761U;
  const float wet = condition == Condition::kRain ? 0.62F : 1.0F;
  const int near_side = route.near_side;
  const auto texels = [](double distance_m) {
    return distance_m < 2.5 ? 48.0 : distance_m < 9 ? 24.0 : 12.0;
  };
  const Sheet sheet{.cell_m = 4,
                    .height_m = 0,
                    .reach_m = 16,
                    .facing_up = true,
                    .wear_m = 3,
                    .wear = 0.5F,
                    .seed = seed32,
                    .texels_per_m = texels};
  const auto colour = [=](const Eigen::Vector2d& p, const Place& place, float wear) {
    return street_colour(p, place, wear, near_side, seed32) * wet;
  };
  add_sheet(sheet, route_lines(route, true), colour, builder);
  // Waste ground to the horizon, a little lower so that the street hides it.
  const Eigen::Vector2d middle = (route.corners.front() + route.corners.back()) / 2;
  const double half_m = (route.corners.back() - route.corners.front()).norm() / 2 + 300;
  builder.add({middle.x() - half_m, middle.y() + half_m, -0.05}, {2 * half_m, 0, 0}, {0, -2 * half_m, 0},
              512 / half_m, [=](cv::Size size) {
                Canvas canvas(size, {2 * half_m, 2 * half_m}, scaled(Colour(70, 108, 104), wet));
                canvas.stain({0, 0, 2 * half_m, 2 * half_m}, {30, 30}, 0.3, seed32);
                return canvas.painting();
              });
}

void add_corridor_floor(const Route& route, std::uint64_t seed, double half_width_m, double height_m,
                        WorldBuilder& builder) {
  const auto seed32 = static_cast<std::uint32_t>(seed ^ (seed >> 32U)) * 2654435761U;
  const Lines lines = route_lines(route, true);
  Sheet sheet{.cell_m = 4,
              .height_m = 0,
              .reach_m = half_width_m,
              .facing_up = true,
              .wear_m = 1.5,
              .wear = 0.15F,
              .seed = seed32,
              .texels_per_m = [](double) { return 64.0; }};
  const auto floor = [=](const Eigen::Vector2d& p, const Place& place, float wear) {
    return floor_colour(p, place, wear, seed32);
  };
  add_sheet(sheet, lines, floor, builder);
  sheet.height_m = height_m;
  sheet.facing_up = false;
  sheet.texels_per_m = [](double) { return 32.0; };
  sheet.wear = 0.05F;
  const auto ceiling = [=](const Eigen::Vector2d&, const Place& place, float wear) {
    return ceiling_colour(place, seed32) * wear;
  };
  add_sheet(sheet, lines, ceiling, builder);
}

}  // namespace simulate
