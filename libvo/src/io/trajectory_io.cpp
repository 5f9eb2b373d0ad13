#include "vo/io/trajectory_io.hpp"

#include "vo/base/error.hpp"
#include "vo/io/csv.hpp"
#include "vo/io/pose_series_io.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vo {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

/// Headings turn clockwise from +y, yaw counter-clockwise from +x.
double yaw_from_heading(double heading_rad) {
  return std::numbers::pi / 2 - heading_rad;
}

}  // namespace

WalkTruth read_truth(const std::filesystem::path& path) {
  const CsvTable table = CsvTable::read(path);
  const std::vector<double> time_s = table.numbers("time_s");
  const std::vector<double> x_m = table.numbers("x_m");
  const std::vector<double> y_m = table.numbers("y_m");
  const std::vector<double> heading_deg = table.numbers("heading_deg");

  WalkTruth truth;
  truth.frame = table.indices("frame");
  truth.distance_m = table.numbers("distance_m");
  if (table.has("steps")) truth.steps = table.indices("steps");
  if (table.rows() == 0) throw Error(path.string(), "has no rows", "one row for each frame");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (truth.frame[i] != static_cast<std::int64_t>(i)) {
      throw Error(table.where(i), fmt::format("frame is {}", truth.frame[i]), fmt::format("{}", i));
    }
    if (i > 0 && time_s[i] <= time_s[i - 1]) {
      throw Error(table.where(i), fmt::format("time {} s does not follow {} s", time_s[i], time_s[i - 1]),
                  "strictly increasing times");
    }
    if (i > 0 && truth.distance_m[i] < truth.distance_m[i - 1]) {
      throw Error(table.where(i),
                  fmt::format("distance {} m is less than the {} m before", truth.distance_m[i],
                              truth.distance_m[i - 1]),
                  "the distance travelled since the start, which never decreases");
    }
    truth.poses.push_back({time_s[i], {x_m[i], y_m[i], wrap_angle_rad(heading_deg[i] * kRadPerDeg)}});
  }
  return truth;
}

Trajectory read_tum(const std::filesystem::path& path) {
  return planar(read_pose_series(path, {.axes = TrajectoryAxes::kVehicle}));
}

std::string to_tum(const Trajectory& trajectory, std::string_view comment) {
  std::string text;
  if (!comment.empty()) text = fmt::format("# {}\n", comment);
  for (const auto& [time_s, pose] : trajectory) {
    const double half_yaw_rad = yaw_from_heading(pose.heading_rad) / 2;
    text += fmt::format("{:.6f} {:.6f} {:.6f} 0 0 0 {:.9f} {:.9f}\n", time_s, pose.x_m, pose.y_m,
                        std::sin(half_yaw_rad), std::cos(half_yaw_rad));
  }
  return text;
}

}  // namespace vo
