#include "vo/io/trajectory_io.hpp"

#include "vo/base/degrees.hpp"
#include "vo/base/error.hpp"
#include "vo/io/csv.hpp"
#include "vo/io/pose_series_io.hpp"
#include "vo/io/time_unit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vo {
namespace {

/// Headings turn clockwise from +y, yaw counter-clockwise from +x.
double yaw_from_heading(double heading_rad) {
  return std::numbers::pi / 2 - heading_rad;
}

/// Refuses times that are not in seconds, as the distances between them say it.
void check_seconds(const WalkTruth& truth, const std::string& path) {
  constexpr double kHour_s = 3600;  // pictures may be taken one by one
  double length_m = 0;
  const Pose2* before = nullptr;
  for (const std::optional<Pose2>& pose : truth.pose) {
    if (pose && before != nullptr) length_m += std::hypot(pose->x_m - before->x_m, pose->y_m - before->y_m);
    if (pose) before = &*pose;
  }
  const std::vector<double> along_m = distances_between(truth);
  if (!along_m.empty()) length_m = std::max(length_m, along_m.back() - along_m.front());
  const TimeUnit unit = time_unit(truth.time_s, length_m, kHour_s);
  if (unit.name.empty()) return;
  throw Error(path,
              fmt::format("has times in {}, as it seems: {:.0f} m from {:.10g} to {:.10g}", unit.name,
                          length_m, truth.time_s.front(), truth.time_s.back()),
              "time_s in seconds");
}

}  // namespace

WalkTruth read_truth(const std::filesystem::path& path) {
  const CsvTable table = CsvTable::read(path);
  const auto x_m = table.optional_numbers("x_m"), y_m = table.optional_numbers("y_m");
  const auto heading_deg = table.optional_numbers("heading_deg");

  WalkTruth truth;
  truth.time_s = table.numbers("time_s");
  truth.frame = table.indices("frame");
  truth.distance_m = table.optional_numbers("distance_m");
  if (table.has("steps")) truth.steps = table.optional_indices("steps");
  if (table.rows() == 0) throw Error(path.string(), "has no rows", "one row for each frame");
  std::optional<double> before_m;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (truth.frame[i] != static_cast<std::int64_t>(i)) {
      throw Error(table.where(i), fmt::format("frame is {}", truth.frame[i]), fmt::format("{}", i));
    }
    if (i > 0 && truth.time_s[i] <= truth.time_s[i - 1]) {
      throw Error(table.where(i),
                  fmt::format("time {} s does not follow {} s", truth.time_s[i], truth.time_s[i - 1]),
                  "strictly increasing times");
    }
    const std::optional<double>& distance_m = truth.distance_m[i];
    if (distance_m && before_m && *distance_m < *before_m) {
      throw Error(table.where(i),
                  fmt::format("distance {} m is less than the {} m before", *distance_m, *before_m),
                  "the distance travelled since the start, which never decreases");
    }
    if (distance_m) before_m = distance_m;
    const bool known = x_m[i] && y_m[i] && heading_deg[i];
    truth.pose.push_back(
        known ? std::optional(Pose2{*x_m[i], *y_m[i], wrap_angle_rad(*heading_deg[i] * kRadPerDeg)})
              : std::nullopt);
  }
  check_seconds(truth, path.string());
  return truth;
}

Trajectory poses_of(const WalkTruth& truth) {
  Trajectory poses;
  for (std::size_t i = 0; i < truth.pose.size(); ++i)
    if (truth.pose[i]) poses.push_back({truth.time_s[i], *truth.pose[i]});
  return poses;
}

PosesAlongRoute poses_along_route(const WalkTruth& truth) {
  PosesAlongRoute known;
  for (std::size_t i = 0; i < truth.pose.size(); ++i) {
    if (!truth.pose[i] || !truth.distance_m[i]) continue;
    known.poses.push_back({truth.time_s[i], *truth.pose[i]});
    known.distance_m.push_back(*truth.distance_m[i]);
  }
  return known;
}

std::optional<std::int64_t> steps_in_all(const WalkTruth& truth) {
  std::optional<std::int64_t> last;
  for (const std::optional<std::int64_t>& steps : truth.steps)
    if (steps) last = steps;
  return last;
}

std::vector<double> distances_between(const WalkTruth& truth) {
  std::vector<double> filled;
  std::optional<std::size_t> before;
  for (std::size_t i = 0; i < truth.distance_m.size(); ++i) {
    if (!truth.distance_m[i]) continue;
    const double to_m = *truth.distance_m[i], from_m = before ? *truth.distance_m[*before] : to_m;
    while (filled.size() < i) {
      const double share =
          before ? static_cast<double>(filled.size() - *before) / static_cast<double>(i - *before) : 0;
      filled.push_back(std::lerp(from_m, to_m, share));
    }
    filled.push_back(to_m);
    before = i;
  }
  if (before) filled.resize(truth.distance_m.size(), filled.back());
  return filled;
}

Trajectory read_tum(const std::filesystem::path& path) {
  const PoseSeries series = read_pose_series(path, {.axes = TrajectoryAxes::kVehicle});
  if (series.time_s.empty())
    throw Error(path.string(), "has poses without times", "TUM's lines of 8 numbers");
  return planar(series);
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
