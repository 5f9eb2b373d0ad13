#pragma once

#include "match/traverse_costs.hpp"
#include "place/match/route_matching.hpp"

#include <string>
#include <vector>

namespace place {

/// A walk's costs against each traverse of a route (`costs`), joined with the others' costs for its places
/// (`fuse_traverses`). Traverses are found on each other as a walk is. `warnings`: gets a line for each pair
/// that shares no place.
std::vector<CostMatrix> joined_traverses(const Route& route, const std::vector<TraverseCosts>& costs,
                                         const RouteMatchingOptions& options,
                                         std::vector<std::string>& warnings);

}  // namespace place
