#pragma once

#include "world.hpp"

#include <cstdint>

namespace simulate {

/// The sky all round with clouds, and a skyline of distant houses and hills below it.
void add_sky(std::uint64_t seed, Condition condition, WorldBuilder& builder);

}  // namespace simulate
