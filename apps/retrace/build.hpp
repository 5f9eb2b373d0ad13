#pragma once

#include "settings.hpp"

#include <cstddef>
#include <optional>
#include <string>

#include <place/localiser.hpp>

namespace retrace {

/// What became of a walk that was added to a route.
struct AddedTraverse {
  std::size_t index = 0;  ///< in the route
  double scale = 1;       ///< its displacement was multiplied by this to fit the route's
};

/// Samples a walk as the settings say and puts it into the route under `name`, over the traverse that has the
/// name already. A route's sampling unit comes from its first traverse. Throws `vo::Error` if the walk gives
/// fewer than two keyframes.
AddedTraverse add_traverse(place::Route& route, const std::string& name, const vo::Walk& walk,
                           const std::optional<place::Survey>& survey, const Settings& settings);

}  // namespace retrace
