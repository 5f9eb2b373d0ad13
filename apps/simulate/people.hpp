#pragma once

#include "lighting.hpp"
#include "path.hpp"
#include "rasteriser.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace simulate {

/// Someone who walks along the route at a steady speed, drawn as an upright figure that faces the camera.
struct Passer {
  double begin_m;    ///< where on the route at time 0
  double speed_mps;  ///< along it; negative if coming towards the walker
  double right_m;    ///< of the route
  double height_m;
  std::array<std::shared_ptr<const Texture>, 4> strides;  ///< the figure in the course of a stride
};

/// Draws people who meet the walker at times spread over the walk. `distance_at` gives the walker's distance
/// along the route at a time; passers keep clear of `walker_right_m` and within `room_m` of the route.
std::vector<Passer> draw_people(int count, double duration_s,
                                const std::function<double(double)>& distance_at, double walker_right_m,
                                double room_m, bool night, std::uint64_t seed);

/// The passers as the camera sees them at a time, in the light of where they are.
std::vector<Surface> people_at(const std::vector<Passer>& people, const Path& route, double time_s,
                               const Eigen::Vector3d& camera, const Lighting& lighting);

}  // namespace simulate
