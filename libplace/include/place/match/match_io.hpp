#pragma once

#include "place/match/match.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace place {

struct Route;

/// matches.csv: a row for each query keyframe, in order; frames are those of the source videos.
std::string to_csv(std::span<const Match> matches);

/// Reads it back; what the file does not say (keyframes, poses) is filled in by `locate`. Times, traverses
/// and distances may be missing. Throws `vo::Error` naming file and line for anything else that is, a match
/// without a score, or no rows.
std::vector<Match> read_matches(const std::filesystem::path& path);

/// Puts the matches' keyframes and poses in from their route. Throws `vo::Error` for a traverse or a keyframe
/// that the route does not have. O(matches log keyframes).
void locate(std::vector<Match>& matches, const Route& route);

}  // namespace place
