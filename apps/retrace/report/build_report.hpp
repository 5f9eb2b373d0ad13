#pragma once

#include <cstddef>
#include <string>

#include <place/place.hpp>
#include <vo/odometry.hpp>

namespace retrace {

/// The report of a walk that was added to a route, as `build --report` writes it: what was kept, how its
/// motion was learned (`put_alignment`), and its speed before and after sampling. `added`: of `place::add`.
std::string build_report(const place::Route& route, const place::AddedTraverse& added, const vo::Walk& walk,
                         const place::Settings& settings);

}  // namespace retrace
