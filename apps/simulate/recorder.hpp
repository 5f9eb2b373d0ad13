#pragma once

#include "simulator.hpp"

#include <filesystem>

#include <vo/base/progress.hpp>

namespace simulate {

/// What was written.
struct Recording {
  int frames = 0;
  TruthRow last{};  ///< of the last frame: how long, how far, how many steps
};

/// Draws a walk into `directory`, which is made if need be: `walk.mp4` (MPEG-4) and `truth.csv`, one row per
/// frame: frame,time_s,x_m,y_m,heading_deg,distance_m,steps.
///
/// Each file is written under a temporary name and renamed when it is whole. A progress callback that returns
/// false ends the walk early; what was drawn is kept. Throws `vo::Error` if an option is out of range, if one
/// of the files exists and `overwrite` is false, or if they cannot be written. Two cores draw some 100 frames
/// of 640x360 a second by day and less than half of that by night.
Recording simulate_walk(const Options& options, const std::filesystem::path& directory, bool overwrite,
                        const vo::ProgressCallback& progress = {});

}  // namespace simulate
