#pragma once

#include "run_summary.hpp"
#include "side_video.hpp"

#include <string>
#include <vector>

#include <place/match/match.hpp>
#include <place/route/route.hpp>

namespace retrace {

/// What a run's video is made of.
struct SideVideoInput {
  std::string folder;                  ///< written by `retrace localise`
  std::string route;                   ///< its database
  std::vector<std::string> query;      ///< recordings of the query, in order; empty: as the run knows them
  std::vector<std::string> reference;  ///< of the reference (`traverse_files`); empty: sought near the route
  int width_px = 640;
  bool warp = false, blink = false;  ///< see `SideVideo`
};

/// Finds the recordings and the cameras. Traverses whose recording is not found are shown by the route's
/// previews, with a warning in the log. Throws `vo::Error` for recordings that cannot be opened or are not
/// those of the run, a traverse with matches but without any picture, and `warp` where no match has a yaw.
SideVideo side_video_of(const SideVideoInput& input, const place::Route& route,
                        const std::vector<place::Match>& matches, const RunSummary& summary);

}  // namespace retrace
