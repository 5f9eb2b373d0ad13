#pragma once

#include "follow_matches.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <place/route/route.hpp>
#include <place/settings.hpp>

namespace retrace {

/// The files that `retrace follow -o` writes.
extern const std::vector<std::string> kFollowFiles;

/// What a run of `retrace follow` was.
struct FollowRun {
  std::string walk, route;  ///< as given
  std::int64_t frames = 0, on_route = 0, skipped = 0;
  double duration_s = 0;
  double lag_s = 0;
  std::optional<double> start_utc_s;
  std::vector<std::string> warnings;
};

/// Writes those files of a run that `localise` has too, so that what reads its runs reads these: matches.csv,
/// trajectory.tum (and .geojson, .gpx where the route is on the earth) of the places, summary.json,
/// config.toml.
void write_follow_files(const std::filesystem::path& folder, const FollowRun& run, const place::Route& route,
                        const place::Settings& settings, std::vector<place::Match> matches);

}  // namespace retrace
