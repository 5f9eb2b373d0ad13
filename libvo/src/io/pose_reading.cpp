#include "io/pose_reading.hpp"

#include "vo/io/csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <opencv2/core/eigen.hpp>

namespace vo {
namespace {

/// The first of a column's names that the table has; empty if it has none.
std::string_view column(const CsvTable& table, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    if (table.has(name)) return name;
  }
  return {};
}

/// A CSV file's columns, as retrace, EuRoC and evo name them.
struct PoseColumns {
  std::vector<std::optional<double>> time, x, y, z, qx, qy, qz, qw, heading_deg;
};

/// A column of times whose name says what they are in.
struct TimeColumn {
  std::string_view name;
  TimeUnit unit;
};
constexpr std::array kTimeColumns{
    TimeColumn{"timestamp [ns]", kNanoseconds},  TimeColumn{"timestamp_ns", kNanoseconds},
    TimeColumn{"time_ns", kNanoseconds},         TimeColumn{"timestamp [us]", kMicroseconds},
    TimeColumn{"timestamp_us", kMicroseconds},   TimeColumn{"time_us", kMicroseconds},
    TimeColumn{"timestamp [ms]", kMilliseconds}, TimeColumn{"timestamp_ms", kMilliseconds},
    TimeColumn{"time_ms", kMilliseconds}};

PoseColumns pose_columns(const CsvTable& table, std::optional<TimeUnit>& unit) {
  const auto needed = [&](std::initializer_list<std::string_view> names) {
    const std::string_view name = column(table, names);
    return table.numbers_where_they_are(name.empty() ? *names.begin() : name);
  };
  const auto wanted = [&](std::initializer_list<std::string_view> names) {
    const std::string_view name = column(table, names);
    return name.empty() ? std::vector<std::optional<double>>() : table.numbers_where_they_are(name);
  };
  const auto named = std::ranges::find_if(kTimeColumns, [&](const auto& c) { return table.has(c.name); });
  const bool seconds = !column(table, {"time_s", "timestamp"}).empty();
  if (named != kTimeColumns.end() && !seconds) unit = named->unit;
  return {.time = unit ? needed({named->name}) : needed({"time_s", "timestamp", "time", "t"}),
          .x = needed({"x_m", "tx", "x", "p_RS_R_x [m]"}),
          .y = needed({"y_m", "ty", "y", "p_RS_R_y [m]"}),
          .z = wanted({"z_m", "tz", "z", "p_RS_R_z [m]"}),
          .qx = wanted({"qx", "q_RS_x []"}),
          .qy = wanted({"qy", "q_RS_y []"}),
          .qz = wanted({"qz", "q_RS_z []"}),
          .qw = wanted({"qw", "q_RS_w []"}),
          .heading_deg = wanted({"heading_deg"})};
}

}  // namespace

std::optional<cv::Matx33d> from_quaternion(Reading& reading, double x, double y, double z, double w) {
  const Eigen::Quaterniond q(w, x, y, z);
  constexpr double kZero = 1e-6, kUnit = 0.01;  // TUM's files carry four digits and more
  if (!(q.norm() > kZero)) return std::nullopt;
  if (std::abs(q.norm() - 1) > kUnit) ++reading.rescaled;
  cv::Matx33d rotation;
  cv::eigen2cv(Eigen::Matrix3d(q.normalized().toRotationMatrix()), rotation);
  return rotation;
}

Reading read_tum_lines(const NumberFile& file) {
  Reading reading{.lines = file.lines.size()};
  reading.poses.reserve(reading.lines);
  for (const NumberLine& line : file.lines) {
    const std::vector<double>& v = line.values;
    if (!line.wrong.empty() || v.size() != kTumCells) {
      reading.leave_out(file.where(line), problem_of(line));
    } else if (const auto rotation = from_quaternion(reading, v[4], v[5], v[6], v[7])) {
      reading.poses.push_back(
          {.time = v[0], .pose = {.rotation = *rotation, .position = {v[1], v[2], v[3]}}});
    } else {
      reading.leave_out(file.where(line), "has a quaternion of zeros");
    }
  }
  return reading;
}

Reading read_kitti_lines(const NumberFile& file) {
  Reading reading{.lines = file.lines.size()};
  reading.poses.reserve(reading.lines);
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const std::vector<double>& v = file.lines[i].values;
    if (!file.lines[i].wrong.empty() || v.size() != kKittiCells) {
      reading.leave_out(file.where(file.lines[i]), problem_of(file.lines[i]));
      continue;
    }
    const cv::Matx33d rotation(v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10]);
    constexpr double kTolerance = 1e-2;  // files carry six digits
    if (cv::norm(rotation * rotation.t() - cv::Matx33d::eye()) > kTolerance ||
        cv::determinant(rotation) < 0) {
      reading.leave_out(file.where(file.lines[i]), "is no rotation and position");
      continue;
    }
    reading.poses.push_back({.frame = i, .pose = {.rotation = rotation, .position = {v[3], v[7], v[11]}}});
  }
  return reading;
}

Reading read_pose_csv(const std::filesystem::path& path, std::optional<FoundAxes>& axes) {
  const CsvTable table = CsvTable::read(path, UnevenRows::kLeaveOut);
  Reading reading{.lines = table.rows() + table.left_out(), .left_out = table.left_out()};
  if (reading.left_out > 0) {
    reading.first_where = path.string();
    reading.first_problem = fmt::format("has rows of another length than its header");
  }
  const PoseColumns c = pose_columns(table, reading.unit);
  const bool turned = !c.qx.empty() && !c.qy.empty() && !c.qz.empty() && !c.qw.empty();
  const bool headed = !turned && !c.heading_deg.empty();
  if (headed) axes = {BodyAxes::kVehicle, GroundPlane::kXY};
  if (!turned && !headed) axes = {BodyAxes::kNone, GroundPlane::kXY};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto bad = [&](const std::string& problem) { reading.leave_out(table.where(i), problem); };
    if (!c.time[i] || !c.x[i] || !c.y[i] || (!c.z.empty() && !c.z[i])) {
      bad("has no time and place");
      continue;
    }
    FilePose pose{.time = *c.time[i], .pose = {.position = {*c.x[i], *c.y[i], c.z.empty() ? 0 : *c.z[i]}}};
    if (turned) {
      const bool there = c.qx[i] && c.qy[i] && c.qz[i] && c.qw[i];
      const auto rotation =
          there ? from_quaternion(reading, *c.qx[i], *c.qy[i], *c.qz[i], *c.qw[i]) : std::nullopt;
      if (!rotation) {
        bad("has no quaternion");
        continue;
      }
      pose.pose.rotation = *rotation;
    } else if (headed) {
      if (!c.heading_deg[i]) {
        bad("has no heading_deg");
        continue;
      }
      const double yaw = (90 - *c.heading_deg[i]) * std::numbers::pi / 180;
      pose.pose.rotation = {std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0, 0, 0, 1};
    }
    reading.poses.push_back(pose);
  }
  return reading;
}

}  // namespace vo
