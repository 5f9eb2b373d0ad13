#pragma once

#include "arguments.hpp"

#include <string>

namespace retrace {

/// Makes a route database of a folder that `retrace inspect --export` wrote, and prints what is in it. Throws
/// `vo::Error` if the folder is not as it should be, or the route exists and `force` is not given.
void import_route(const std::string& folder, const std::string& output, const CommonOptions& common);

}  // namespace retrace
