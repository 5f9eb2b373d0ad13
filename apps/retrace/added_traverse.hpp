#pragma once

#include <string>

#include <place/place.hpp>

namespace retrace {

/// Prints what `build` added to the route at `path`, as text or as JSON, on standard output.
void print_added(const std::string& path, const place::Route& route, const place::AddedTraverse& added,
                 bool as_json);

}  // namespace retrace
