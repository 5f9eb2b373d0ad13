#include "odometry_charts.hpp"

#include "report/alignment_figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <vo/base/degrees.hpp>
#include <vo/base/frame_range.hpp>

namespace retrace {
namespace {

/// Time ranges of consecutive elements that satisfy `shaded`.
template <typename Shaded>
std::vector<std::pair<double, double>> spans(const std::vector<double>& time_s, Shaded shaded) {
  std::vector<std::pair<double, double>> found;
  bool open = false;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (shaded(i) && !open) found.emplace_back(time_s[i], time_s[i]);
    open = shaded(i);
    // Up to where the next begins, so that neighbours touch.
    if (open) found.back().second = time_s[std::min(i + 1, time_s.size() - 1)];
  }
  return found;
}

Band unreliable(const OdometryView& walk) {
  const auto& frames = walk.frames;
  auto shaded = spans(frames.time_s, [&](std::size_t i) { return i > 0 && frames.reliable[i] == 0; });
  return {.name = "too few matches, bridged", .colour = "ochre", .spans = std::move(shaded)};
}

/// A threshold above and, for the other leg, below 0.
Series threshold_lines(const OdometryView& walk, std::string name, const std::vector<double>& values,
                       std::vector<int> dash) {
  Series series{.name = std::move(name), .colour = "green", .dash = std::move(dash), .width_px = 1.2};
  for (const double sign : {1.0, -1.0}) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      series.x.push_back(walk.frames.time_s[i]);
      series.y.push_back(sign * values[i]);
    }
    series.x.push_back(walk.frames.time_s.back());
    series.y.push_back(NAN);
  }
  return series;
}

Series step_series(const OdometryView& walk, const std::string& leg, bool bridged) {
  Series series{.name = leg + (bridged ? " step, bridged" : " step"),
                .colour = leg == "left" ? "orange" : "purple",
                .line = false,
                .mark = leg == "left" ? "triangle" : "diamond",
                .hollow = bridged,
                .size_px = 6};
  const auto& steps = walk.steps;
  for (std::size_t i = 0; i < steps.time_s.size(); ++i) {
    if (steps.leg[i] != leg || (steps.bridged[i] != 0) != bridged) continue;
    series.x.push_back(steps.time_s[i]);
    const auto frame = static_cast<std::size_t>(steps.frame[i]);
    series.y.push_back(frame < walk.frames.signal.size() ? walk.frames.signal[frame] : 0);
    series.notes.push_back(fmt::format("step {}", i + 1));
  }
  return series;
}

/// Speed from the displacement since the frame before, over the half second around each frame.
std::vector<double> over_half_a_second(const std::vector<double>& moved, const std::vector<double>& time_s) {
  std::vector<double> distance(moved.size() + 1, 0), speed;
  for (std::size_t i = 0; i < moved.size(); ++i) distance[i + 1] = distance[i] + moved[i];
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const vo::FrameRange near = vo::frames_around(time_s, {i, i + 1}, 0.25);
    const double seconds = time_s[near.end - 1] - time_s[near.begin];
    speed.push_back(seconds > 0 ? (distance[near.end] - distance[near.begin + 1]) / seconds : NAN);
  }
  return speed;
}

/// The true speed; none without true poses.
std::optional<Series> true_speed(const OdometryView& walk) {
  if (walk.truth == nullptr || walk.truth->poses.size() < 2) return {};
  std::vector<double> moved{0}, time_s{walk.truth->poses.front().time_s};
  for (std::size_t i = 1; i < walk.truth->poses.size(); ++i) {
    const vo::TimedPose &from = walk.truth->poses[i - 1], &to = walk.truth->poses[i];
    moved.push_back(std::hypot(to.pose.x_m - from.pose.x_m, to.pose.y_m - from.pose.y_m));
    time_s.push_back(to.time_s);
  }
  return Series{.name = "truth",
                .x = time_s,
                .y = over_half_a_second(moved, time_s),
                .colour = "green",
                .dash = {7, 5}};
}

/// The speed by one source, in whose lost frames nothing is moved; none if it has no frame.
std::optional<Series> speed_alone(const OdometryView& walk, std::string name,
                                  const std::vector<double>& displacement, std::string colour) {
  if (std::ranges::all_of(displacement, [](double value) { return std::isnan(value); })) return {};
  std::vector<double> moved;
  for (const double value : displacement) moved.push_back(std::isnan(value) ? 0 : value);
  return Series{.name = std::move(name),
                .x = walk.frames.time_s,
                .y = over_half_a_second(moved, walk.frames.time_s),
                .colour = std::move(colour),
                .width_px = 1};
}

/// Headings without jumps by whole turns.
std::vector<double> unwrapped_deg(const vo::Trajectory& trajectory) {
  std::vector<double> headings;
  double before = 0, sum = 0;
  for (const vo::TimedPose& pose : trajectory) {
    sum += headings.empty() ? 0 : vo::wrap_angle_rad(pose.pose.heading_rad - before);
    before = pose.pose.heading_rad;
    headings.push_back(sum * vo::kDegPerRad);
  }
  return headings;
}

/// A chart of the odometry's speed, for others to be compared with.
Chart odometry_speed(const OdometryView& walk, std::string title) {
  const auto& frames = walk.frames;
  return {.title = std::move(title),
          .x_title = "time, s",
          .y_title = fmt::format("speed, {}/s", walk.summary.unit),
          .series = {{.name = "odometry",
                      .x = frames.time_s,
                      .y = over_half_a_second(frames.displacement, frames.time_s),
                      .colour = "orange"}},
          .zoomable = true,
          .size = "wide"};
}

}  // namespace

std::optional<Chart> gait_chart(const OdometryView& walk) {
  if (walk.frames.time_s.empty()) return {};
  const std::string read_from = walk.summary.step_signal;
  const bool by_orientation = read_from.starts_with("orientation");
  Chart chart{.title = "gait signal with thresholds and steps",
              .x_title = "time, s",
              .y_title = by_orientation ? "orientation change, deg a frame" : read_from + ", px a frame",
              .bands = {unreliable(walk)},
              .zoomable = true,
              .size = "tall"};
  for (const char* leg : {"left", "right"}) {
    for (const bool bridged : {false, true}) {
      Series steps = step_series(walk, leg, bridged);
      if (!steps.x.empty()) chart.series.push_back(std::move(steps));
    }
  }
  chart.series.push_back(
      {.name = "signal, low-passed", .x = walk.frames.time_s, .y = walk.frames.signal, .colour = "blue"});
  chart.series.push_back(threshold_lines(walk, "dynamic threshold", walk.frames.threshold, {}));
  if (walk.summary.delta_min) {
    const std::vector<double> level(walk.frames.time_s.size(), *walk.summary.delta_min);
    chart.series.push_back(threshold_lines(walk, "static threshold", level, {7, 5}));
  }
  if (by_orientation) {
    chart.series.push_back({.name = "as measured",
                            .x = walk.frames.time_s,
                            .y = walk.frames.orientation_deg,
                            .colour = "grey",
                            .width_px = 0.8});
  }
  // The raw signal has outliers; what matters lies within the low-passed one.
  double top = 0;
  for (const double value : walk.frames.signal) top = std::max(top, std::abs(value));
  if (top > 0) chart.y_range = {-1.3 * top, 1.3 * top};
  return chart;
}

std::optional<Chart> activity_chart(const OdometryView& walk) {
  const auto& seconds = walk.activity;
  if (seconds.time_s.empty()) return {};
  Chart chart{.title = "what was done in each second, with the cadence",
              .x_title = "time, s",
              .y_title = "steps a second",
              .series = {{.name = "cadence",
                          .x = seconds.time_s,
                          .y = seconds.step_hz,
                          .colour = "blue",
                          .mark = "circle"}},
              .zoomable = true,
              .size = "wide"};
  static const std::map<std::string, std::string> kColours{{"standing", "grey"},
                                                           {"walking", "green"},
                                                           {"running", "orange"},
                                                           {"riding", "blue"},
                                                           {"unknown", "purple"}};
  for (const auto& [activity, colour] : kColours) {
    Band band{.name = activity, .colour = colour};
    for (std::size_t i = 0; i < seconds.time_s.size(); ++i) {
      if (seconds.activity[i] != activity) continue;
      const double from = seconds.time_s[i], to = from + 1;
      if (!band.spans.empty() && band.spans.back().second >= from)
        band.spans.back().second = to;
      else
        band.spans.emplace_back(from, to);
    }
    if (!band.spans.empty()) chart.bands.push_back(std::move(band));
  }
  return chart;
}

std::optional<Chart> heading_chart(const OdometryView& walk) {
  if (walk.frames.time_s.empty()) return {};
  Chart chart{.title = "heading since the first frame",
              .x_title = "time, s",
              .y_title = "heading, deg clockwise",
              .series = {{.name = "odometry",
                          .x = walk.frames.time_s,
                          .y = walk.frames.heading_deg,
                          .colour = "orange"}},
              .zoomable = true};
  if (!walk.turns.empty()) chart.bands.push_back(turn_band(walk.turns));
  if (walk.truth != nullptr && !walk.truth->poses.empty()) {
    Series truth{.name = "truth", .y = unwrapped_deg(walk.truth->poses), .colour = "green", .dash = {7, 5}};
    for (const vo::TimedPose& pose : walk.truth->poses) truth.x.push_back(pose.time_s);
    chart.series.push_back(std::move(truth));
  }
  return chart;
}

std::optional<Chart> speed_chart(const OdometryView& walk) {
  const auto& frames = walk.frames;
  if (frames.time_s.size() < 2) return {};
  Chart chart = odometry_speed(walk, "speed");
  if (std::optional<Series> truth = true_speed(walk)) chart.series.push_back(std::move(*truth));
  // SSS Fig. 9: each source by itself. Lost frames have no displacement.
  const auto add_alone = [&](std::string name, const std::vector<double>& displacement, std::string colour) {
    if (std::optional<Series> alone = speed_alone(walk, std::move(name), displacement, std::move(colour)))
      chart.series.push_back(std::move(*alone));
  };
  add_alone("visual odometry alone", frames.vo_displacement, "blue");
  add_alone("alignment error alone", frames.sad_displacement, "purple");
  static const std::map<std::string, std::pair<std::string, std::string>> kShaded{
      {"steps", {"by steps", "ochre"}},
      {"sad", {"by alignment error", "purple"}},
      {"held", {"held", "grey"}}};
  if (std::ranges::find(frames.source, "vo") == frames.source.end())
    return chart;  // everything is from steps
  for (const auto& [source, shown] : kShaded) {
    auto shaded =
        spans(frames.time_s, [&, &name = source](std::size_t i) { return frames.source[i] == name; });
    if (!shaded.empty())
      chart.bands.push_back({.name = shown.first, .colour = shown.second, .spans = std::move(shaded)});
  }
  return chart;
}

std::optional<Chart> scale_jumps_chart(const OdometryView& walk) {
  const auto& frames = walk.frames;
  if (frames.time_s.size() < 2) return {};
  std::optional<Series> jumping =
      speed_alone(walk, "visual odometry as it comes", frames.vo_as_it_comes, "blue");
  if (!jumping) return {};
  Chart chart = odometry_speed(walk, "speed by visual odometry with its jumps of scale");
  chart.series.push_back(std::move(*jumping));
  if (std::optional<Series> truth = true_speed(walk)) chart.series.push_back(std::move(*truth));
  constexpr double kShown = 3;  // times the odometry's: a unit may be a hundred times another
  double top = 0;
  for (const double speed : chart.series[0].y) top = std::fmax(top, kShown * speed);
  double most = 0;
  for (const double speed : chart.series[1].y) most = std::fmax(most, 1.05 * speed);
  if (top > 0) chart.y_range = {0.0, std::min(top, std::max(most, top / kShown * 1.05))};
  auto lost =
      spans(frames.time_s, [&](std::size_t i) { return i > 0 && std::isnan(frames.vo_as_it_comes[i]); });
  if (!lost.empty()) chart.bands.push_back({.name = "lost", .colour = "grey", .spans = std::move(lost)});
  return chart;
}

std::optional<Chart> matches_chart(const OdometryView& walk) {
  if (walk.frames.time_s.empty()) return {};
  return Chart{
      .title = "matches of each frame",
      .x_title = "time, s",
      .y_title = "matches",
      .series = {{.name = "matches", .x = walk.frames.time_s, .y = walk.frames.matches, .colour = "blue"}},
      .bands = {unreliable(walk)},
      .zoomable = true,
      .size = "wide"};
}

}  // namespace retrace
