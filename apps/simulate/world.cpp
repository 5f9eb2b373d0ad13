#include "world.hpp"

#include "path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <vo/base/parallel.hpp>

namespace simulate {
namespace {

Eigen::Vector3d lifted(const Eigen::Vector2d& point, double height_m) {
  return {point.x(), point.y(), height_m};
}

}  // namespace

void WorldBuilder::add(const Eigen::Vector3d& corner, const Eigen::Vector3d& across,
                       const Eigen::Vector3d& down, double texels_per_m, Painter painter) {
  const auto texels = [&](const Eigen::Vector3d& edge) {
    return std::max(1, static_cast<int>(std::lround(edge.norm() * texels_per_m)));
  };
  plans_.push_back({{corner, across, down, nullptr, 1}, {texels(across), texels(down)}, std::move(painter)});
}

void WorldBuilder::add_wall(const Eigen::Vector2d& left, const Eigen::Vector2d& right, double bottom_m,
                            double top_m, double texels_per_m, Painter painter) {
  add(lifted(left, top_m), lifted(right - left, 0), {0, 0, bottom_m - top_m}, texels_per_m,
      std::move(painter));
}

void WorldBuilder::add_box(const Box& box, double texels_per_m,
                           const std::function<Painter(Face)>& painter_of) {
  const double h = box.centre.heading_rad;
  const Eigen::Vector2d centre(box.centre.x_m, box.centre.y_m);
  const Eigen::Vector2d ahead = Eigen::Vector2d(std::sin(h), std::cos(h)) * (box.length_m / 2);
  const Eigen::Vector2d right = Eigen::Vector2d(std::cos(h), -std::sin(h)) * (box.width_m / 2);
  const auto wall = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b, Face face) {
    add_wall(centre + a, centre + b, box.bottom_m, box.top_m, texels_per_m, painter_of(face));
  };
  wall(right - ahead, right + ahead, Face::kSide);
  wall(ahead - right, -ahead - right, Face::kSide);
  wall(ahead + right, ahead - right, Face::kEnd);
  wall(-ahead - right, right - ahead, Face::kEnd);
  add(lifted(centre + ahead - right, box.top_m), lifted(2 * right, 0), lifted(-2 * ahead, 0), texels_per_m,
      painter_of(Face::kTop));
}

void WorldBuilder::add_backdrop(const Eigen::Vector3d& corner, const Eigen::Vector3d& across,
                                const Eigen::Vector3d& down, cv::Size texels, Painter painter) {
  backdrop_plans_.push_back({{corner, across, down, nullptr, 1}, texels, std::move(painter)});
}

World WorldBuilder::finish(Scene scene, Condition condition) const {
  // By day the street's lamps are off.
  const bool lamps_on = scene == Scene::kCorridor || condition == Condition::kNight;
  World world{{}, {}, Lighting(scene, condition, lamps_on ? lamps_ : std::vector<Lamp>{})};
  const auto paint_all = [&](const std::vector<Plan>& plans, bool lit, std::vector<Surface>& surfaces) {
    surfaces.resize(plans.size());
    vo::parallel_for(plans.size(), [&](std::size_t i) {
      surfaces[i] = plans[i].surface;
      const Painting painting = plans[i].painter(plans[i].texels);
      surfaces[i].texture = std::make_shared<const Texture>(lit ? bake(painting, surfaces[i], world.lighting)
                                                                : bake_evenly(painting, {1, 1, 1}));
    });
  };
  paint_all(plans_, true, world.surfaces);
  paint_all(backdrop_plans_, false, world.backdrop);
  return world;
}

}  // namespace simulate
