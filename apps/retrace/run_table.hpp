#pragma once

#include <string>

#include <place/place.hpp>

namespace retrace {

/// What `retrace localise` says of a run on standard output: a line for each count.
std::string run_table(const vo::Walk& walk, const place::Route& route, const std::string& route_path,
                      const place::Run& run);

}  // namespace retrace
