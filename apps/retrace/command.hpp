#pragma once

#include "arguments.hpp"

#include <functional>

namespace retrace {

/// The accepted forms of a walk, for help.
inline constexpr const char* kWalkArgument =
    "video file, folder of images, or camera:N; several files in order are one walk";

/// Declares a command's arguments and returns the action to run after parsing.
using Declare = std::function<void()>(Arguments&);

Declare declare_build, declare_localise, declare_correct, declare_evaluate, declare_follow, declare_odometry,
    declare_evaluate_odometry, declare_sweep_odometry, declare_sweep, declare_compare, declare_inspect,
    declare_describe, declare_simulate, declare_demo, declare_config, declare_video, declare_doctor;

}  // namespace retrace
