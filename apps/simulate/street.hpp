#pragma once

#include "route.hpp"
#include "world.hpp"

#include <cstdint>

namespace simulate {

/// Builds a street along the route, in metres to the near side of the walker's line: facades at about 3, the
/// pavement from 3.5 to -2, a road with parked cars to -9, a pavement and facades at about -12. The near row
/// is open at each side street.
void build_street(const Route& route, std::uint64_t seed, Condition condition, WorldBuilder& builder);

}  // namespace simulate
