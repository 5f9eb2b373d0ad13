#pragma once

#include "place/match/match.hpp"

#include <optional>
#include <span>
#include <string>

namespace place {

/// What a user should know of a walk that is hardly found on a route: a sentence with what was seen and what
/// to try, or none where it is found. Found is a walk of which at least a twentieth of the keyframes is
/// accepted; by chance, with the default of 0.95, fewer are. `walk`: its name. O(matches).
std::optional<std::string> not_found(const std::string& walk, std::span<const Match> matches);

}  // namespace place
