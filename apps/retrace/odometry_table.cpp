#include "odometry_table.hpp"

#include <string_view>

#include <fmt/format.h>

namespace retrace {

std::string odometry_table(const vo::Walk& walk, const vo::WalkMotion& walked, double step_length_m,
                           const WrittenOdometry& written, const OdometryExtras& extras) {
  std::string table = walk.source + "\n";
  const auto row = [&](std::string_view name, const std::string& value, const std::string& note) {
    table += fmt::format("  {:<10}{:>10}   {}\n", name, value, note);
  };
  const vo::PedestrianMotion& motion = *walked.pedestrian;
  row("steps", std::to_string(motion.detection.steps.size()),
      fmt::format("{} of them bridged", motion.detection.bridged));
  if (extras.imu_steps) row("imu", std::to_string(*extras.imu_steps), "steps by the camera's accelerometer");
  row("distance", fmt::format("{:.1f} {}", written.distance, written.unit),
      walked.metric ? fmt::format("steps of {:.3f} m", step_length_m)
                    : "no steps, so no metres: see --camera-height-m");
  row("duration", fmt::format("{:.1f} s", walk.time_s.back()),
      fmt::format("{} frames, {} with too few points", walk.frames(), motion.signal.bridged));
  if (extras.loops != nullptr)
    row("loops", std::to_string(extras.loops->loops),
        fmt::format("places seen before, {} of them believed", extras.loops->believed));
  return table;
}

}  // namespace retrace
