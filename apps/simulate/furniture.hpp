#pragma once

#include "world.hpp"

#include <cstdint>

#include <vo/base/pose2.hpp>

namespace simulate {

struct TreeSize {
  double crown_radius_m, trunk_m;
};

/// Things that stand about; each seed is another one. Poses are of their middle on the ground.
void add_tree(const vo::Pose2& pose, const TreeSize& size, std::uint64_t seed, WorldBuilder& builder);
void add_car(const vo::Pose2& pose, std::uint64_t seed, WorldBuilder& builder);
/// A lamp post; also a source of light.
void add_street_lamp(const vo::Pose2& pose, double height_m, const cv::Vec3f& bgr, std::uint64_t seed,
                     WorldBuilder& builder);
/// A bin, a bench, a bollard, a junction box or a board on the pavement.
void add_street_thing(const vo::Pose2& pose, std::uint64_t seed, WorldBuilder& builder);
/// A cupboard, a chair, a bin or a plant by a corridor's wall.
void add_corridor_thing(const vo::Pose2& pose, std::uint64_t seed, WorldBuilder& builder);
/// A hedge across a gap between houses, with bushes and a tree behind it.
void add_garden(const vo::Pose2& pose, double width_m, std::uint64_t seed, WorldBuilder& builder);

}  // namespace simulate
