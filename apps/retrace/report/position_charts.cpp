#include "position_charts.hpp"

#include "report/page.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include <vo/base/degrees.hpp>
#include <vo/base/error.hpp>

namespace retrace {
namespace {

/// The point of a path at this distance along it, or its end.
place::MapPoint point_along(const std::vector<place::MapPoint>& path, double metres) {
  double walked = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double leg = std::hypot(path[i].x_m - path[i - 1].x_m, path[i].y_m - path[i - 1].y_m);
    if (leg > 0 && walked + leg >= metres) {
      const double share = (metres - walked) / leg;
      return {std::lerp(path[i - 1].x_m, path[i].x_m, share), std::lerp(path[i - 1].y_m, path[i].y_m, share)};
    }
    walked += leg;
  }
  return path.back();
}

/// Moves and rotates a path so that it begins where `truth` does, in the same direction over the first
/// metres.
std::vector<place::MapPoint> laid_on(std::vector<place::MapPoint> path,
                                     const std::vector<place::MapPoint>& truth) {
  constexpr double kFirst_m = 5;
  const auto direction = [](const std::vector<place::MapPoint>& points) {
    const place::MapPoint at = point_along(points, kFirst_m);
    return std::atan2(at.y_m - points.front().y_m, at.x_m - points.front().x_m);
  };
  const double turn = direction(truth) - direction(path);
  const double cosine = std::cos(turn), sine = std::sin(turn);
  const place::MapPoint from = path.front(), to = truth.front();
  for (place::MapPoint& point : path) {
    const double x = point.x_m - from.x_m, y = point.y_m - from.y_m;
    point = {to.x_m + cosine * x - sine * y, to.y_m + sine * x + cosine * y};
  }
  return path;
}

std::vector<place::MapPoint> points_of(const vo::Trajectory& trajectory) {
  std::vector<place::MapPoint> points;
  for (const vo::TimedPose& pose : trajectory) points.push_back({pose.pose.x_m, pose.pose.y_m});
  return points;
}

Series path_series(const std::vector<place::MapPoint>& points, std::string name, std::string colour) {
  Series series{.name = std::move(name), .colour = std::move(colour)};
  for (const place::MapPoint& point : points) {
    series.x.push_back(point.x_m);
    series.y.push_back(point.y_m);
  }
  return series;
}

Backdrop map_backdrop(const OdometryTruth& truth) {
  std::ifstream file(truth.map_image, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  const cv::Mat image = bytes.empty() ? cv::Mat() : cv::imdecode(bytes, cv::IMREAD_COLOR);
  if (image.empty()) throw vo::Error(truth.map_image.string(), "is no picture", "a PNG or JPEG of the map");
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", image, jpeg);
  return {.source = data_url(jpeg),
          .left = 0,
          .right = image.cols * truth.map_scale_m_per_px,
          .top = 0,
          .bottom = -image.rows * truth.map_scale_m_per_px};  // down on the map is south
}

/// The mean of a measure with its standard deviation above and below, at each measured distance.
std::optional<Chart> error_chart(const OdometryView& walk, Chart chart, double place::OdometryErrors::*mean,
                                 double place::OdometryErrors::*sd) {
  if (walk.truth == nullptr) return {};
  Series middle{.name = "mean", .colour = "blue", .mark = "circle"};
  Series above{.name = "mean plus one standard deviation", .colour = "grey", .dash = {5, 4}};
  Series below{.name = "mean minus one", .colour = "grey", .dash = {2, 4}};
  for (const place::OdometryErrors& errors : walk.truth->evaluation.errors) {
    if (errors.count == 0) continue;
    for (const auto& [series, sign] : {std::pair{&middle, 0}, std::pair{&above, 1}, std::pair{&below, -1}}) {
      series->x.push_back(errors.at_m);
      series->y.push_back(errors.*mean + sign * errors.*sd);
    }
    middle.notes.push_back(fmt::format("sd {:.3g}, {} segments", errors.*sd, errors.count));
  }
  chart.x_title = "distance travelled, m";
  chart.series = {middle, above, below};
  chart.size = "wide";
  return chart;
}

}  // namespace

std::optional<Chart> trajectory_chart(const OdometryView& walk) {
  if (walk.trajectory.size() < 2) return {};
  Chart chart{.title = "trajectory",
              .x_title = fmt::format("x, {}", walk.summary.unit),
              .y_title = fmt::format("y, {}", walk.summary.unit),
              .equal = true,
              .zoomable = true,
              .size = "tall"};
  std::vector<place::MapPoint> path = points_of(walk.trajectory);
  if (walk.truth != nullptr) {
    const std::vector<place::MapPoint> truth =
        walk.truth->map_path.empty() ? points_of(walk.truth->poses) : walk.truth->map_path;
    path = laid_on(std::move(path), truth);
    chart.series.push_back(path_series(truth, "truth", "green"));
    chart.series.back().dash = {7, 5};
    if (!walk.truth->map_image.empty()) chart.backdrop = map_backdrop(*walk.truth);
  }
  chart.series.push_back(path_series({path.front()}, "start", "purple"));
  chart.series.back().line = false;
  chart.series.back().mark = "square";
  chart.series.back().size_px = 7;
  if (!walk.turns.empty()) {
    Series turns{.name = "turn", .colour = "purple", .line = false, .mark = "diamond", .size_px = 6};
    for (const vo::WalkedTurn& turn : walk.turns) {
      const auto at = std::ranges::lower_bound(walk.trajectory, (turn.begin_s + turn.end_s) / 2, {},
                                               &vo::TimedPose::time_s) -
                      walk.trajectory.begin();
      const auto& point = path[std::min(static_cast<std::size_t>(at), path.size() - 1)];
      turns.x.push_back(point.x_m);
      turns.y.push_back(point.y_m);
      turns.notes.push_back(fmt::format("{:+.0f} deg", turn.turn_rad * vo::kDegPerRad));
    }
    chart.series.push_back(std::move(turns));
  }
  chart.series.push_back(path_series(path, "odometry", "orange"));
  for (const vo::TimedPose& pose : walk.trajectory)
    chart.series.back().notes.push_back(fmt::format("{:.1f} s", pose.time_s));
  return chart;
}

std::optional<Chart> position_error_chart(const OdometryView& walk) {
  return error_chart(walk, {.title = "position error against distance", .y_title = "position error, m"},
                     &place::OdometryErrors::euclidean_mean_m, &place::OdometryErrors::euclidean_sd_m);
}

std::optional<Chart> heading_error_chart(const OdometryView& walk) {
  return error_chart(walk,
                     {.title = "heading error against distance", .y_title = "heading error, deg to the left"},
                     &place::OdometryErrors::heading_mean_deg, &place::OdometryErrors::heading_sd_deg);
}

}  // namespace retrace
