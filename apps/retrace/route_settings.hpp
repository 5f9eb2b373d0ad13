#pragma once

#include "settings.hpp"

#include <string>

#include <place/route/route_database.hpp>

namespace retrace {

/// Puts what the route fixes into the settings: thumbnail and patch always, motion and sampling where the
/// user did not give them. Throws `vo::Error` naming the route and the field where the user gave a thumbnail
/// or patch that its descriptors do not fit, or asked for motion on a route that was sampled without.
void take_from_route(const CLI::App& app, const std::string& path, const place::Route& route,
                     Settings& settings);

/// A new route's own settings, from the user's.
place::Route new_route(const Settings& settings);

}  // namespace retrace
