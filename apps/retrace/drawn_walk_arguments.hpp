#pragma once

#include "arguments.hpp"

#include <simulate/options.hpp>

namespace retrace {

/// The route, the walker and the camera of a walk that the simulator draws. It checks their ranges itself, as
/// they depend on the scene.
void declare_drawn_walk(Arguments& arguments, simulate::Options& walk);

}  // namespace retrace
