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

/// Reads it back; `locate` fills in what the file does not contain (keyframes, poses). Times, traverses and
/// distances may be missing. Throws `vo::Error` naming file and line if anything else is missing, a match has
/// no score, or there are no rows.
std::vector<Match> read_matches(const std::filesystem::path& path);

/// Fills in the matches' keyframes and poses from their route. Throws `vo::Error` for a traverse or keyframe
/// that the route does not have. O(matches log keyframes).
void locate(std::vector<Match>& matches, const Route& route);

}  // namespace place
