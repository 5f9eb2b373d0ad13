#pragma once

#include "odometry_files.hpp"

#include <string>

#include <vo/odometry.hpp>

namespace retrace {

/// What `retrace odometry` says of a walk on standard output: a line for each count.
std::string odometry_table(const vo::Walk& walk, const vo::WalkMotion& walked, double step_length_m,
                           const WrittenOdometry& written, const OdometryExtras& extras);

}  // namespace retrace
