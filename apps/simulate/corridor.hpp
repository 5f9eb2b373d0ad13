#pragma once

#include "route.hpp"
#include "world.hpp"

#include <cstdint>

namespace simulate {

/// Builds a corridor along the route, 2.4 m wide and 2.6 m high: plain walls with doors, posters and notice
/// boards, things standing by them, and stretches where both walls are all but blank.
void build_corridor(const Route& route, std::uint64_t seed, WorldBuilder& builder);

}  // namespace simulate
