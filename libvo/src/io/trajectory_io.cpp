#include "vo/io/trajectory_io.hpp"

#include "vo/base/error.hpp"
#include "vo/io/csv.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include <fmt/format.h>

namespace vo {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

/// Headings turn clockwise from +y, yaw counter-clockwise from +x.
double yaw_from_heading(double heading_rad) {
  return std::numbers::pi / 2 - heading_rad;
}
double heading_from_yaw(double yaw_rad) {
  return wrap_angle_rad(std::numbers::pi / 2 - yaw_rad);
}

void check_increasing(const std::string& where, const Trajectory& before, double time_s) {
  if (!before.empty() && time_s <= before.back().time_s) {
    throw Error(where, fmt::format("time {} s does not follow {} s", time_s, before.back().time_s),
                "strictly increasing times");
  }
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
    check_increasing(table.where(i), truth.poses, time_s[i]);
    truth.poses.push_back({time_s[i], {x_m[i], y_m[i], wrap_angle_rad(heading_deg[i] * kRadPerDeg)}});
  }
  return truth;
}

Trajectory read_tum(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!std::filesystem::is_regular_file(path) || !file) {
    throw Error(path.string(), "cannot be read", "a trajectory in TUM's form");
  }
  Trajectory trajectory;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    const std::string where = fmt::format("{}: line {}", path.string(), number);
    std::istringstream cells(line);
    std::array<double, 8> value{};
    for (double& cell : value) {
      if (!(cells >> cell)) throw Error(where, "is not 8 numbers", "time x y z qx qy qz qw");
    }
    if (std::string rest; cells >> rest)
      throw Error(where, "has more than 8 cells", "time x y z qx qy qz qw");
    const auto [time_s, x_m, y_m, z_m, qx, qy, qz, qw] = value;
    check_increasing(where, trajectory, time_s);
    if (std::hypot(std::hypot(qx, qy), std::hypot(qz, qw)) < 0.5) {
      throw Error(where, "has no unit quaternion", "qx qy qz qw of length 1");
    }
    const double yaw_rad = std::atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
    trajectory.push_back({time_s, {x_m, y_m, heading_from_yaw(yaw_rad)}});
  }
  if (trajectory.empty()) throw Error(path.string(), "has no pose", "lines of time x y z qx qy qz qw");
  return trajectory;
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
