#pragma once

#include "route.hpp"
#include "world.hpp"

#include <cstdint>

namespace simulate {

/// Paves the street and what lies around it. The ground is one picture of the world, painted by position and
/// cut into square cells, finer where one walks.
void add_street_ground(const Route& route, std::uint64_t seed, Condition condition, WorldBuilder& builder);

/// The corridor's floor and its ceiling, `height_m` up, `half_width_m` to either side of the line and of the
/// side corridors.
void add_corridor_floor(const Route& route, std::uint64_t seed, double half_width_m, double height_m,
                        WorldBuilder& builder);

}  // namespace simulate
