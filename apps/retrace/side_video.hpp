#pragma once

#include "walk_pictures.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <place/match/reference_timeline.hpp>
#include <place/route/route.hpp>
#include <vo/base/progress.hpp>
#include <vo/geometry/camera.hpp>

namespace retrace {

/// What a traverse is shown by.
struct ShownTraverse {
  std::unique_ptr<WalkPictures> pictures;  ///< null: none of it is shown
  bool previews = false;                   ///< small pictures of the keyframes only
  std::optional<vo::Camera> camera;        ///< to turn its pictures; none: they are not turned
};

/// A run as its video shows it.
struct SideVideo {
  const place::Route& route;
  const std::vector<place::Match>& matches;
  std::vector<place::QueryMoment> timeline;  ///< a moment for each frame of the query
  std::unique_ptr<WalkPictures> query;
  std::optional<vo::Camera> query_camera;  ///< to turn the reference to it; none: it is not turned
  std::vector<ShownTraverse> traverses;    ///< the route's
  int width_px = 640;
  bool blink = false;  ///< below, reference and query take turns, half a second each
};

/// Writes the video, whole or not at all: one frame for each of the query's, at the query's rate (the median
/// between its keyframes), Above is the query, below
/// it the reference's frame nearest to where the query is (`place::reference_timeline`), or "off route".
/// Where the match has a yaw and both cameras are given, the reference is turned to the query's view
/// (`vo::turned_view`): a rotation only, so what is near stays shifted if the walker was to the side. Returns
/// the rate, frames a second. Throws `vo::Error` if a recording or the file fails; what `progress` throws.
double write_side_video(const std::filesystem::path& path, SideVideo& video,
                        const vo::ProgressCallback& progress);

}  // namespace retrace
