#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include <place/route/route.hpp>

namespace retrace {

/// The contents of the route database at `path`, keyframe by keyframe.
nlohmann::ordered_json route_json(const std::string& path, const place::Route& route);

/// The same for people, on standard output, traverse by traverse.
void print_route(const std::string& path, const place::Route& route);

}  // namespace retrace
