#pragma once

#include "match/traverse_costs.hpp"
#include "place/match/route_matching.hpp"

#include <string>
#include <vector>

namespace place {

/// A walk's costs against each traverse of a route (`costs`), joined with what the others say of its places
/// (`fuse_traverses`). Where traverses lie on each other is found as a walk is found. `warnings`: gets a line
/// for each two that share no place.
std::vector<CostMatrix> joined_traverses(const Route& route, const std::vector<TraverseCosts>& costs,
                                         const RouteMatchingOptions& options,
                                         std::vector<std::string>& warnings);

}  // namespace place
