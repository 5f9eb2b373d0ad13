#include "vo/io/pose_series_io.hpp"

#include "io/pose_lines.hpp"
#include "io/pose_reading.hpp"
#include "vo/base/error.hpp"
#include "vo/io/csv.hpp"
#include "vo/io/text_file.hpp"
#include "vo/io/time_unit.hpp"
#include "vo/io/trajectory_axes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <opencv2/core/eigen.hpp>

namespace vo {
namespace {

constexpr std::string_view kPoseForms = "TUM's lines of 8 numbers, KITTI's of 12, or a CSV with a header";

/// Gives the poses of KITTI's form the times of their frames.
void add_times(Reading& reading, const std::filesystem::path& path) {
  const NumberFile file = read_number_lines(path, "one time in seconds a line");
  for (const NumberLine& line : file.lines) {
    if (!line.wrong.empty() || line.values.size() != 1)
      throw Error(file.where(line), problem_of(line), "one time in seconds");
  }
  if (file.lines.size() != reading.lines) {
    throw Error(path.string(), fmt::format("has {} times", file.lines.size()),
                fmt::format("{}, one for each pose", reading.lines));
  }
  for (FilePose& pose : reading.poses) pose.time = file.lines[pose.frame].values[0];
}

/// What a file's times are in, as a column's name or their size says it.
TimeUnit unit_of(const Reading& reading) {
  if (reading.unit) return *reading.unit;
  std::vector<double> times;
  double length = 0;
  for (std::size_t i = 0; i < reading.poses.size(); ++i) {
    times.push_back(reading.poses[i].time);
    if (i > 0) length += cv::norm(reading.poses[i].pose.position - reading.poses[i - 1].pose.position);
  }
  return time_unit(times, length);
}

/// Sorts by time and leaves out what has a time that is there already.
void put_in_order(Reading& reading, PoseSeries& series, const std::string& name) {
  const TimeUnit unit = unit_of(reading);
  if (!unit.name.empty())
    series.warnings.push_back(fmt::format("{}: times in {}, converted to seconds", name, unit.name));
  std::size_t unsorted = 0;
  for (std::size_t i = 1; i < reading.poses.size(); ++i)
    unsorted += reading.poses[i].time < reading.poses[i - 1].time ? 1 : 0;
  if (unsorted > 0) {
    std::ranges::stable_sort(reading.poses, {}, &FilePose::time);
    series.warnings.push_back(
        fmt::format("{}: {} times are before those of the line above; sorted", name, unsorted));
  }
  for (const FilePose& pose : reading.poses) {
    const double time_s = pose.time / unit.per_second;
    if (!series.time_s.empty() && time_s <= series.time_s.back()) {
      reading.leave_out(name, fmt::format("has the time {:.10g} s twice", time_s));
      continue;
    }
    series.time_s.push_back(time_s);
    series.poses.push_back(pose.pose);
  }
}

void take_axes(PoseSeries& series, const std::optional<FoundAxes>& known, TrajectoryAxes said) {
  const FoundAxes found = known ? *known : find_axes(series.poses);
  series.axes = found.body;
  series.ground = found.ground;
  if (known || said == TrajectoryAxes::kAuto) return;
  if (said == TrajectoryAxes::kVehicle) {
    series.axes = BodyAxes::kVehicle;
    series.ground = GroundPlane::kXY;
  } else {
    series.axes = BodyAxes::kCamera;
    if (found.ground == GroundPlane::kUnknown || found.body == BodyAxes::kVehicle)
      series.ground = GroundPlane::kXZ;
  }
}

/// True if the first line that says something separates names by commas, semicolons or tabs; EuRoC has them
/// in a comment.
bool is_csv(const std::filesystem::path& path) {
  const TextFile file = read_text_file(path, kPoseForms);
  for (const TextLine& line : file.lines) {
    const std::string_view text = trimmed(line.text);
    const bool separated = text.find_first_of(",;\t") != std::string_view::npos;
    if (text.empty()) continue;
    if (text.starts_with('#')) {
      const std::size_t name = text.find_first_not_of("# '\"");
      if (separated && text.substr(std::min(name, text.size())).starts_with("timestamp")) return true;
      continue;
    }
    const std::string_view first = text.substr(0, text.find_first_of(",;\t "));
    return separated && !parse_number(without_quotes(first)) && first != "nan" && first != "NaN";
  }
  return false;
}

}  // namespace

PoseSeries read_pose_series(const std::filesystem::path& path, const PoseFileOptions& options) {
  const std::string name = path.string();
  Reading reading;
  std::optional<FoundAxes> known;
  bool timed = true;
  if (is_csv(path)) {
    reading = read_pose_csv(path, known);
  } else {
    const NumberFile file = read_number_lines(path, kPoseForms);
    const auto whole = std::ranges::find_if(file.lines, [](const NumberLine& line) {
      return line.wrong.empty() && (line.values.size() == kTumCells || line.values.size() == kKittiCells);
    });
    timed = whole == file.lines.end() || whole->values.size() == kTumCells;
    reading = timed ? read_tum_lines(file) : read_kitti_lines(file);
  }
  if (options.kitti_times) {
    if (timed) throw Error(name, "has times of its own", "none beside it, or poses in KITTI's form");
    add_times(reading, *options.kitti_times);
    timed = true;
  }
  if (reading.lines == 0) throw Error(name, "has no pose", kPoseForms);
  if (2 * reading.left_out >= reading.lines)
    throw Error(reading.first_where, reading.first_problem, kPoseForms);

  PoseSeries series{.source = name};
  if (timed) {
    put_in_order(reading, series, name);
  } else {
    series.frames = reading.lines;
    for (const FilePose& pose : reading.poses) {
      series.frame.push_back(pose.frame);
      series.poses.push_back(pose.pose);
    }
  }
  if (reading.left_out > 0) {
    series.warnings.push_back(fmt::format("{}: {} of {} lines are left out; the first: {} {}", name,
                                          reading.left_out, reading.lines, reading.first_where,
                                          reading.first_problem));
  }
  if (reading.rescaled > 0) {
    series.warnings.push_back(
        fmt::format("{}: {} quaternions are not of length 1; normalised", name, reading.rescaled));
  }
  take_axes(series, known, options.axes);
  return series;
}

Trajectory planar(const PoseSeries& series) {
  if (series.time_s.size() != series.poses.size())
    throw std::invalid_argument("planar: one time for each pose expected");
  if (series.ground == GroundPlane::kUnknown) {
    throw Error(series.source, "does not show which of its axes is up",
                "--axes vehicle (x forward, z up) or --axes camera (x right, y down, z forward)");
  }
  const int north = series.ground == GroundPlane::kXY ? 1 : 2;
  const int forward = series.axes == BodyAxes::kVehicle ? 0 : 2;
  Trajectory trajectory;
  for (std::size_t i = 0; i < series.poses.size(); ++i) {
    const Pose3& pose = series.poses[i];
    // Both grounds have x to the right of north, seen from above.
    const double heading_rad = std::atan2(pose.rotation(0, forward), pose.rotation(north, forward));
    trajectory.push_back({series.time_s[i], {pose.position[0], pose.position[north], heading_rad}});
  }
  if (series.axes == BodyAxes::kNone) head_along_path(trajectory, kPathHeading_m);
  return trajectory;
}

std::string to_tum(const std::vector<std::optional<Pose3>>& poses, const std::vector<double>& time_s,
                   std::string_view comment) {
  if (poses.size() != time_s.size()) throw std::invalid_argument("to_tum: one time for each pose expected");
  std::string text = fmt::format("# {}\n", comment);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!poses[i]) continue;
    Eigen::Matrix3d rotation;
    cv::cv2eigen(poses[i]->rotation, rotation);
    const Eigen::Quaterniond q(rotation);
    const cv::Vec3d& p = poses[i]->position;
    text += fmt::format("{:.6f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", time_s[i], p[0], p[1],
                        p[2], q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

}  // namespace vo
