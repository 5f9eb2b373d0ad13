#pragma once

#include "lighting.hpp"
#include "rasteriser.hpp"

#include <functional>
#include <vector>

#include <vo/base/pose2.hpp>

namespace simulate {

/// All that stands still, ready to be drawn.
struct World {
  std::vector<Surface> surfaces;
  std::vector<Surface> backdrop;  ///< sky and skyline; moves with the camera
  Lighting lighting;
};

/// Paints a surface whose texture has the given size.
using Painter = std::function<Painting(cv::Size)>;

/// Collects surfaces and how each is painted; paints and lights them all at the end, in parallel.
class WorldBuilder {
 public:
  /// A surface without texture yet. `texels_per_m` sets how finely it is painted.
  void add(const Eigen::Vector3d& corner, const Eigen::Vector3d& across, const Eigen::Vector3d& down,
           double texels_per_m, Painter painter);

  /// An upright wall on the ground from `left` to `right` as one sees it, between two heights.
  void add_wall(const Eigen::Vector2d& left, const Eigen::Vector2d& right, double bottom_m, double top_m,
                double texels_per_m, Painter painter);

  /// The four upright faces and the top of a box around `centre` (its heading along `length_m`). The painter
  /// is asked for the long sides, the short ones and the top alike.
  struct Box {
    vo::Pose2 centre;
    double length_m, width_m, bottom_m, top_m;
  };
  enum class Face { kSide, kEnd, kTop };
  void add_box(const Box& box, double texels_per_m, const std::function<Painter(Face)>& painter_of);

  /// A piece of the backdrop, relative to the camera.
  void add_backdrop(const Eigen::Vector3d& corner, const Eigen::Vector3d& across, const Eigen::Vector3d& down,
                    cv::Size texels, Painter painter);

  void add_lamp(const Lamp& lamp) { lamps_.push_back(lamp); }

  /// Paints everything. The outcome does not depend on the number of threads.
  [[nodiscard]] World finish(Scene scene, Condition condition) const;

 private:
  struct Plan {
    Surface surface;
    cv::Size texels;
    Painter painter;
  };

  std::vector<Plan> plans_, backdrop_plans_;
  std::vector<Lamp> lamps_;
};

}  // namespace simulate
