#include "run_charts.hpp"

#include "report/pr_chart.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

/// Points of the matches for which `keep` holds.
template <typename Keep, typename Value>
Series match_series(const RunView& run, std::string name, Keep keep, Value value) {
  Series series{.name = std::move(name), .line = false};
  for (std::size_t q = 0; q < run.matches.size(); ++q) {
    if (!keep(q)) continue;
    series.x.push_back(run.matches[q].query_time_s);
    series.y.push_back(value(q));
    series.notes.push_back(
        fmt::format("frame {}, score {:.3g}", run.matches[q].query_frame, run.matches[q].score));
  }
  return series;
}

Series accepted_style(Series series) {
  series.colour = "orange";
  series.mark = "circle";
  return series;
}

Series refused_style(Series series) {
  series.colour = "blue";
  series.mark = "square";
  series.hollow = true;
  return series;
}

Series level(std::string name, const RunView& run, double value) {
  return {.name = std::move(name),
          .x = {run.matches.front().query_time_s, run.matches.back().query_time_s},
          .y = {value, value},
          .colour = "green",
          .dash = {7, 5}};
}

/// The query and each traverse, with their names in a figure.
struct NamedWalk {
  std::string name;
  const WalkColumns* data;
  bool query = false;
};

std::vector<NamedWalk> walks(const RunView& run) {
  std::vector<NamedWalk> all;
  if (run.query) all.push_back({"query", &*run.query, true});
  for (const WalkColumns& traverse : run.traverses) all.push_back({"reference " + traverse.name, &traverse});
  return all;
}

/// A line without marks: these have too many points for them.
Series walk_style(Series series, std::size_t index) {
  series = styled(std::move(series), index);
  series.mark.clear();
  return series;
}

std::vector<double> differences(const std::vector<double>& values) {
  std::vector<double> steps(values.size());
  std::adjacent_difference(values.begin(), values.end(), steps.begin());
  if (!steps.empty()) steps.erase(steps.begin());
  return steps;
}

/// None if there is no such file, or no pose in it: a run on a route without a survey.
vo::Trajectory poses_in(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  try {
    return vo::read_tum(file);
  } catch (const vo::Error&) {
    return {};
  }
}

Series pose_series(const vo::Trajectory& trajectory, std::string name, std::string colour) {
  Series series{.name = std::move(name), .colour = std::move(colour)};
  for (const vo::TimedPose& pose : trajectory) {
    series.x.push_back(pose.pose.x_m);
    series.y.push_back(pose.pose.y_m);
    series.notes.push_back(fmt::format("{:.1f} s", pose.time_s));
  }
  return series;
}

}  // namespace

Chart precision_recall_chart(const RunTruth& truth) {
  Chart chart = precision_recall_plane();
  chart.series.insert(chart.series.begin(),
                      {operating_point("highest F1", truth.evaluation.best, "orange", "star"),
                       operating_point("as accepted", truth.accepted, "green", "diamond"),
                       precision_recall_curve("every threshold", truth.evaluation)});
  return chart;
}

std::optional<Chart> reliability_chart(const RunTruth& truth) {
  if (!truth.calibration) return {};
  Series groups{.name = "groups of matches", .colour = "blue", .mark = "circle", .size_px = 7};
  for (const place::ReliabilityBin& bin : truth.calibration->bins) {
    groups.x.push_back(bin.mean);
    groups.y.push_back(bin.right);
    groups.notes.push_back(
        fmt::format("{} matches of probability {:.3f} to {:.3f}", bin.matches, bin.lowest, bin.highest));
  }
  return Chart{.title = fmt::format("expected calibration error {:.3f}", truth.calibration->error),
               .x_title = "probability",
               .y_title = "share that was right",
               .series = {std::move(groups),
                          {.name = "as claimed", .x = {0, 1}, .y = {0, 1}, .colour = "grey", .dash = {7, 5}}},
               .x_range = std::array{0.0, 1.0},
               .y_range = std::array{0.0, 1.0},
               .size = "tall"};
}

std::optional<Chart> error_chart(const RunView& run) {
  const RunTruth& truth = *run.truth;
  if (!truth.evaluation.errors) return {};
  const std::string unit = truth.unit == place::ErrorUnit::kMetres ? "m" : "frames";
  const auto& percentiles = *truth.evaluation.errors;
  const double top = std::min(std::max(percentiles.max, truth.tolerance) * 1.05,
                              std::max({6 * truth.tolerance, 3 * percentiles.p75, 1e-3}));
  const auto shown = [&](bool accepted) {
    Series series = match_series(
        run, accepted ? "accepted" : "refused",
        [&](std::size_t q) { return truth.errors[q].error && run.matches[q].accepted == accepted; },
        [&](std::size_t q) { return *truth.errors[q].error; });
    for (std::size_t i = 0; i < series.y.size(); ++i) {
      series.notes[i] = fmt::format("error {:.3g} {}, {}", series.y[i], unit, series.notes[i]);
      series.y[i] = std::min(series.y[i], top);
    }
    return series;
  };
  return Chart{.title = "error of each match along the walk",
               .x_title = "query time, s",
               .y_title = "error, " + unit,
               .series = {accepted_style(shown(true)), refused_style(shown(false)),
                          level("tolerance", run, truth.tolerance)},
               .y_range = std::array{0.0, top},
               .zoomable = true};
}

std::optional<Chart> score_chart(const RunView& run) {
  const auto shown = [&](bool accepted) {
    return match_series(
        run, accepted ? "accepted" : "refused",
        [&](std::size_t q) { return run.matches[q].place && run.matches[q].accepted == accepted; },
        [&](std::size_t q) { return run.matches[q].score; });
  };
  Chart chart{.title = "score of each match along the walk",
              .x_title = "query time, s",
              .y_title = "score",
              .series = {accepted_style(shown(true)), refused_style(shown(false))},
              .zoomable = true,
              .size = "wide"};
  if (chart.series[0].x.empty() && chart.series[1].x.empty()) return {};
  if (run.truth != nullptr)
    chart.series.push_back(level("highest F1", run, run.truth->evaluation.best.threshold));
  return chart;
}

std::optional<Chart> speed_chart(const RunView& run) {
  Chart chart{.title = "displacement a second along each walk",
              .x_title = "time, s",
              .y_title = "displacement a second",
              .zoomable = true,
              .size = "wide"};
  const std::vector<NamedWalk> all = walks(run);
  for (std::size_t w = 0; w < all.size(); ++w) {
    const std::vector<double>& time_s = all[w].data->time_s;
    const std::vector<double>& travelled = all[w].data->displacement;
    if (time_s.size() < 2 || travelled.size() != time_s.size() || travelled.back() <= travelled.front())
      continue;
    Series series{.name = all[w].name};
    const double step_s = std::max(0.2, (time_s.back() - time_s.front()) / 2000);
    for (double t = time_s.front() + 0.5; t <= time_s.back() - 0.5; t += step_s) {
      series.x.push_back(t);
      series.y.push_back(interpolated(time_s, travelled, t + 0.5) - interpolated(time_s, travelled, t - 0.5));
    }
    chart.series.push_back(walk_style(std::move(series), w));
  }
  if (chart.series.empty()) return {};
  return chart;
}

std::optional<Chart> keyframe_chart(const RunView& run) {
  if (!(run.unit > 0)) return {};
  Chart chart{.title = "displacement between neighbouring keyframes",
              .x_title = "keyframe",
              .y_title = "displacement, units",
              .zoomable = true,
              .size = "wide"};
  const std::vector<NamedWalk> all = walks(run);
  for (std::size_t w = 0; w < all.size(); ++w) {
    std::vector<double> travelled = all[w].data->displacement;
    if (all[w].query) {  // of every frame
      std::vector<double> at_keyframes;
      for (const double frame : all[w].data->frame) {
        if (frame < static_cast<double>(travelled.size()))
          at_keyframes.push_back(travelled[static_cast<std::size_t>(frame)]);
      }
      travelled = std::move(at_keyframes);
    }
    if (travelled.size() < 2) continue;
    Series series{.name = all[w].name, .x = upto(travelled.size() - 1), .y = differences(travelled)};
    for (double& step : series.y) step /= run.unit;
    chart.series.push_back(walk_style(std::move(series), w));
  }
  if (chart.series.empty()) return {};
  const auto largest = [](double high, const Series& s) { return std::max(high, std::ranges::max(s.y)); };
  chart.y_range = {0.0, 1.1 * std::accumulate(chart.series.begin(), chart.series.end(), 1.5, largest)};
  return chart;
}

std::optional<Chart> spacing_chart(const RunView& run) {
  if (run.truth == nullptr || run.truth->truth.query_distance_m.empty()) return {};
  Chart chart{.title = "metres between neighbouring keyframes",
              .x_title = "keyframe",
              .y_title = "metres",
              .zoomable = true,
              .size = "wide"};
  std::vector<double> along_m;
  const auto& query_m = run.truth->truth.query_distance_m;
  for (const place::Match& match : run.matches) {
    const std::optional<double>& at_m = query_m[static_cast<std::size_t>(match.query_frame)];
    if (at_m) along_m.push_back(*at_m);
  }
  if (along_m.size() < 2) return {};
  chart.series.push_back(walk_style(
      {.name = "query", .x = upto(along_m.size() - 1), .y = differences(along_m)}, chart.series.size()));
  for (const WalkColumns& traverse : run.traverses) {
    if (traverse.distance_m.size() < 2) continue;
    chart.series.push_back(walk_style({.name = "reference " + traverse.name,
                                       .x = upto(traverse.distance_m.size() - 1),
                                       .y = differences(traverse.distance_m)},
                                      chart.series.size()));
  }
  return chart;
}

std::optional<Chart> map_chart(const RunView& run) {
  Chart chart{.title = "map of the walks",
              .x_title = "x, m",
              .y_title = "y, m",
              .equal = true,
              .zoomable = true,
              .size = "tall"};
  for (const WalkColumns& traverse : run.traverses) {
    Series series{.name = "reference " + traverse.name,
                  .x = traverse.x_m,
                  .y = traverse.y_m,
                  .colour = "blue",
                  .dash = {8, 3},
                  .width_px = 4};
    if (std::ranges::any_of(series.x, [](double x) { return std::isfinite(x); }))
      chart.series.push_back(series);
  }
  const bool corrected = std::filesystem::exists(run.folder / "trajectory_odometry.tum");
  const auto read = [&](const char* file) { return poses_in(run.folder / file); };
  if (const vo::Trajectory odometry = read("trajectory_odometry.tum"); !odometry.empty()) {
    chart.series.push_back(pose_series(odometry, "odometry alone", "purple"));
    chart.series.back().dash = {2, 3};
  }
  if (const vo::Trajectory found = read("trajectory.tum"); !found.empty()) {
    Series series = pose_series(found, corrected ? "corrected" : "places of the accepted matches", "orange");
    if (!corrected) series.mark = "circle";
    series.line = corrected;
    chart.series.push_back(std::move(series));
  }
  if (run.truth != nullptr && !run.truth->poses.empty()) {
    Series series = pose_series(run.truth->poses, "query, truly", "green");
    series.dash = {7, 5};
    chart.series.push_back(std::move(series));
  }
  if (chart.series.empty()) return {};
  std::ranges::reverse(chart.series);  // the first is drawn on top
  return chart;
}

}  // namespace retrace
