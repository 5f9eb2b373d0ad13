#pragma once

#include <string>
#include <vector>

#include <place/route/route.hpp>
#include <place/settings.hpp>
#include <vo/odometry.hpp>

namespace retrace {

/// `place::read` for a new route under a progress bar. A walk that goes on until it is ended (`vo::is_live`)
/// ends with Ctrl-C.
vo::Walk read_with_bar(const std::vector<std::string>& files, const place::Settings& settings);

/// The same for a walk to be found on a route.
vo::Walk read_with_bar(const std::vector<std::string>& files, const place::Route& route,
                       const place::Settings& settings);

/// The same by `vo::read_walk`.
vo::Walk read_with_bar(const std::vector<std::string>& files, const vo::WalkOptions& options);

/// Each as a line of the log.
void log_warnings(const std::vector<std::string>& warnings);

}  // namespace retrace
