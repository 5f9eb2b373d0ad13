#include "vo/io/pose_series_io.hpp"

#include "vo/base/error.hpp"
#include "vo/io/csv.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <opencv2/core/eigen.hpp>

namespace vo {
namespace {

/// A line of numbers, and where it is.
struct NumberLine {
  std::string where;
  std::vector<double> values;
};

/// The beginning of what a file holds, which may be no text at all.
std::string printable(std::string_view cell) {
  constexpr std::size_t kMost = 40;
  std::string text(cell.substr(0, kMost));
  for (char& c : text) c = c >= ' ' && c <= '~' ? c : '?';
  return text + (cell.size() > kMost ? "..." : "");
}

std::vector<NumberLine> read_lines(const std::filesystem::path& path, std::string_view expected) {
  std::ifstream file(path);
  if (!std::filesystem::is_regular_file(path) || !file)
    throw Error(path.string(), "cannot be read", expected);
  std::vector<NumberLine> lines;
  std::string text;
  for (std::size_t number = 1; std::getline(file, text); ++number) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string::npos || text[begin] == '#') continue;
    NumberLine line{.where = fmt::format("{}: line {}", path.string(), number), .values = {}};
    std::istringstream cells(text);
    for (std::string cell; cells >> cell;) {
      std::istringstream parser(cell);
      double value = 0;
      if (!(parser >> value) || !parser.eof() || !std::isfinite(value))
        throw Error(line.where, fmt::format("'{}' is no number", printable(cell)), expected);
      line.values.push_back(value);
    }
    lines.push_back(std::move(line));
  }
  if (lines.empty()) throw Error(path.string(), "has no pose", expected);
  return lines;
}

void push_time(PoseSeries& series, const std::string& where, double time_s) {
  if (!series.time_s.empty() && time_s <= series.time_s.back()) {
    throw Error(where, fmt::format("time {} s does not follow {} s", time_s, series.time_s.back()),
                "strictly increasing times");
  }
  series.time_s.push_back(time_s);
}

cv::Matx33d from_quaternion(const std::string& where, double x, double y, double z, double w) {
  const Eigen::Quaterniond q(w, x, y, z);
  constexpr double kLeastLength = 0.5;
  if (q.norm() < kLeastLength) throw Error(where, "has no unit quaternion", "qx qy qz qw of length 1");
  cv::Matx33d rotation;
  cv::eigen2cv(Eigen::Matrix3d(q.normalized().toRotationMatrix()), rotation);
  return rotation;
}

constexpr std::string_view kForms = "TUM's lines of 8 numbers, KITTI's of 12, or a CSV with a header";
constexpr std::size_t kTumCells = 8, kKittiCells = 12;

PoseSeries tum_series(const std::vector<NumberLine>& lines, BodyAxes axes) {
  PoseSeries series{.axes = axes};
  for (const NumberLine& line : lines) {
    if (line.values.size() != kTumCells) {
      throw Error(line.where, fmt::format("has {} numbers", line.values.size()),
                  "8: time x y z qx qy qz qw, as in the first");
    }
    const auto* v = line.values.data();
    push_time(series, line.where, v[0]);
    series.poses.push_back(
        {.rotation = from_quaternion(line.where, v[4], v[5], v[6], v[7]), .position = {v[1], v[2], v[3]}});
  }
  return series;
}

PoseSeries kitti_series(const std::vector<NumberLine>& lines) {
  PoseSeries series;
  for (const NumberLine& line : lines) {
    if (line.values.size() != kKittiCells) {
      throw Error(line.where, fmt::format("has {} numbers", line.values.size()),
                  "12: a 3x4 matrix row by row, as in the first");
    }
    const auto& v = line.values;
    const cv::Matx33d rotation(v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10]);
    constexpr double kTolerance = 1e-2;
    if (cv::norm(rotation * rotation.t() - cv::Matx33d::eye()) > kTolerance ||
        cv::determinant(rotation) < 0) {
      throw Error(line.where, "is no rotation and position", "an orthonormal 3x3 part of determinant 1");
    }
    series.poses.push_back({.rotation = rotation, .position = {v[3], v[7], v[11]}});
  }
  return series;
}

void add_times(PoseSeries& series, const std::filesystem::path& path) {
  const std::vector<NumberLine> lines = read_lines(path, "one time in seconds a line");
  for (const NumberLine& line : lines) {
    if (line.values.size() != 1)
      throw Error(line.where, fmt::format("has {} numbers", line.values.size()), "one time in seconds");
    push_time(series, line.where, line.values[0]);
  }
  if (series.time_s.size() != series.poses.size()) {
    throw Error(path.string(), fmt::format("has {} times", series.time_s.size()),
                fmt::format("{}, one for each pose", series.poses.size()));
  }
}

PoseSeries csv_series(const std::filesystem::path& path, BodyAxes axes) {
  const CsvTable table = CsvTable::read(path);
  const std::vector<double> none(table.rows(), 0);
  const std::vector<double> time_s = table.numbers("time_s"), x_m = table.numbers("x_m"),
                            y_m = table.numbers("y_m"), z_m = table.has("z_m") ? table.numbers("z_m") : none;
  PoseSeries series{.axes = BodyAxes::kNone};
  std::array<std::vector<double>, 4> q;
  std::vector<double> heading_deg;
  if (table.has("qw")) {
    series.axes = axes;
    q = {table.numbers("qx"), table.numbers("qy"), table.numbers("qz"), table.numbers("qw")};
  } else if (table.has("heading_deg")) {
    series.axes = BodyAxes::kVehicle;
    heading_deg = table.numbers("heading_deg");
  }
  for (std::size_t i = 0; i < table.rows(); ++i) {
    push_time(series, table.where(i), time_s[i]);
    Pose3 pose{.position = {x_m[i], y_m[i], z_m[i]}};
    if (!q[0].empty()) pose.rotation = from_quaternion(table.where(i), q[0][i], q[1][i], q[2][i], q[3][i]);
    if (!heading_deg.empty()) {
      const double yaw = (90 - heading_deg[i]) * std::numbers::pi / 180;
      pose.rotation = {std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0, 0, 0, 1};
    }
    series.poses.push_back(pose);
  }
  if (series.poses.empty()) throw Error(path.string(), "has no pose", "rows of time_s,x_m,y_m");
  return series;
}

/// True if the first line that says something has a comma.
bool is_csv(const std::filesystem::path& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin != std::string::npos && line[begin] != '#') return line.find(',') != std::string::npos;
  }
  return false;
}

}  // namespace

PoseSeries read_pose_series(const std::filesystem::path& path, BodyAxes axes,
                            const std::optional<std::filesystem::path>& kitti_times) {
  PoseSeries series;
  if (is_csv(path)) {
    series = csv_series(path, axes);
  } else {
    const std::vector<NumberLine> lines = read_lines(path, kForms);
    const std::size_t cells = lines[0].values.size();
    if (cells != kTumCells && cells != kKittiCells)
      throw Error(lines[0].where, fmt::format("has {} numbers", cells), kForms);
    series = cells == kTumCells ? tum_series(lines, axes) : kitti_series(lines);
  }
  series.source = path.string();
  if (kitti_times) {
    if (!series.time_s.empty())
      throw Error(path.string(), "has times of its own", "none beside it, or poses in KITTI's form");
    add_times(series, *kitti_times);
  }
  return series;
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
