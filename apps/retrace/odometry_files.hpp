#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <place/settings.hpp>
#include <place/trajectory/close_loops.hpp>
#include <vo/motion/walk_motion.hpp>

namespace retrace {

/// The files that `retrace odometry` writes.
extern const std::vector<std::string> kOdometryFiles;

/// Results that are written only on request.
struct OdometryExtras {
  const place::ClosedLoops* loops = nullptr;  ///< the trajectory with loops, and the one before
  bool visual_odometry = false;               ///< visual_odometry.csv and .tum
  std::optional<std::size_t> imu_steps;       ///< those that the accelerometer shows
  vo::VisualMotionOptions visual;             ///< for the figures of alignment error, if motion is without
};

/// Facts about the walk.
struct WrittenOdometry {
  double distance = 0;
  std::string unit;     ///< of the distance: m, or frames or units without metres
  std::string summary;  ///< contents of summary.json
};

/// Writes a walk's odometry into an existing folder: frames.csv, steps.csv, activity.csv, trajectory.tum,
/// summary.json, config.toml, report_data.json and the report. `walked`: with steps.
WrittenOdometry write_odometry(const std::filesystem::path& folder, const vo::Walk& walk,
                               const vo::WalkMotion& walked, const place::Settings& settings,
                               const OdometryExtras& extras);

}  // namespace retrace
