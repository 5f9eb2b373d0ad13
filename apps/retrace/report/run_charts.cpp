#include "run_charts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

/// A column of the run's data; NaN for null.
std::vector<double> numbers(const ordered_json& json, const char* name) {
  std::vector<double> values;
  if (!json.contains(name)) return values;
  for (const ordered_json& value : json[name])
    values.push_back(value.is_number() ? value.get<double>() : NAN);
  return values;
}

const ordered_json& traverses(const RunView& run) {
  static const ordered_json kNone = ordered_json::array();
  return run.data.contains("traverses") ? run.data["traverses"] : kNone;
}

/// y at `at`, linear between the points of increasing x, as at the ends outside.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto right = std::ranges::lower_bound(x, at);
  if (right == x.begin()) return y.front();
  if (right == x.end()) return y.back();
  const auto i = static_cast<std::size_t>(right - x.begin());
  return std::lerp(y[i - 1], y[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
}

std::vector<double> upto(std::size_t count) {
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), 0.0);
  return values;
}

/// The true place of a query frame on the reference, as a frame of it.
std::optional<double> true_frame(const place::GroundTruth& truth, std::int64_t query_frame) {
  if (truth.pairs) return place::true_reference_frame(*truth.pairs, static_cast<double>(query_frame));
  const auto& along = truth.reference_distance_m;
  if (query_frame >= static_cast<std::int64_t>(truth.query_distance_m.size()) || along.empty()) return {};
  const double at_m = truth.query_distance_m[static_cast<std::size_t>(query_frame)];
  if (at_m < along.front() || at_m > along.back()) return {};
  return static_cast<double>(std::ranges::lower_bound(along, at_m) - along.begin());
}

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

/// The query and each traverse in `run.data`, under the name it has in a figure.
struct NamedWalk {
  std::string name;
  const ordered_json* data;
  bool query = false;
};

std::vector<NamedWalk> walks(const RunView& run) {
  std::vector<NamedWalk> all;
  if (run.data.contains("query")) all.push_back({"query", &run.data["query"], true});
  for (const ordered_json& traverse : traverses(run))
    all.push_back({"reference " + traverse["name"].get<std::string>(), &traverse});
  return all;
}

/// Colours and dashes of the walks in one figure.
Series walk_style(Series series, std::size_t index) {
  static const std::vector<std::string> kColours{"orange", "blue", "green", "purple", "ochre", "grey"};
  static const std::vector<std::vector<int>> kDashes{{}, {8, 3}, {2, 3}, {10, 3, 2, 3}};
  series.colour = kColours[index % kColours.size()];
  series.dash = kDashes[index % kDashes.size()];
  return series;
}

std::vector<double> differences(const std::vector<double>& values) {
  std::vector<double> steps(values.size());
  std::adjacent_difference(values.begin(), values.end(), steps.begin());
  if (!steps.empty()) steps.erase(steps.begin());
  return steps;
}

/// None where there is no such file, or no pose in it: a run on a route that was not surveyed.
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

std::optional<Chart> precision_recall_chart(const RunTruth& truth) {
  Chart chart{.title = "precision against recall for every threshold",
              .x_title = "recall",
              .y_title = "precision",
              .x_range = std::array{0.0, 1.0},
              .y_range = std::array{0.0, 1.0},
              .size = "tall"};
  Series curve{.name = "every threshold", .colour = "blue", .mark = "circle"};
  for (const place::OperatingPoint& p : truth.evaluation.curve) {
    curve.x.push_back(p.recall);
    curve.y.push_back(p.precision);
    curve.notes.push_back(fmt::format("threshold {:.4g}, F1 {:.3f}", p.threshold, p.f1));
  }
  const auto point = [](std::string name, const place::OperatingPoint& p, std::string colour,
                        std::string mark) {
    return Series{.name = std::move(name),
                  .x = {p.recall},
                  .y = {p.precision},
                  .colour = std::move(colour),
                  .line = false,
                  .mark = std::move(mark),
                  .size_px = 9,
                  .notes = {fmt::format("threshold {:.4g}, F1 {:.3f}", p.threshold, p.f1)}};
  };
  chart.series = {point("highest F1", truth.evaluation.best, "orange", "star"),
                  point("as accepted", truth.accepted, "green", "diamond"), curve};
  for (const double f1 : {0.2, 0.4, 0.6, 0.8, 0.9}) {  // precision = f1 recall / (2 recall - f1)
    Series line{.name = fmt::format("F1 {}", f1),
                .colour = "grey",
                .dash = {3, 4},
                .width_px = 1,
                .label_at_end = true};
    constexpr int kPoints = 40;
    const double least = f1 / (2 - f1);  // the recall where precision is 1
    for (int i = 0; i <= kPoints; ++i) {
      const double recall =
          std::lerp(least, 1.0, std::pow(static_cast<double>(i) / kPoints, 2));  // closer where it is steep
      line.x.push_back(recall);
      line.y.push_back(f1 * recall / (2 * recall - f1));
    }
    chart.series.push_back(std::move(line));
  }
  return chart;
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
        [&](std::size_t q) { return run.matches[q].reference_frame && run.matches[q].accepted == accepted; },
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
    const std::vector<double> time_s = numbers(*all[w].data, "time_s");
    const std::vector<double> travelled = numbers(*all[w].data, "displacement");
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
  const double unit = run.data.value("unit", 0.0);
  if (!(unit > 0)) return {};
  Chart chart{.title = "displacement between neighbouring keyframes",
              .x_title = "keyframe",
              .y_title = "displacement, units",
              .zoomable = true,
              .size = "wide"};
  const std::vector<NamedWalk> all = walks(run);
  for (std::size_t w = 0; w < all.size(); ++w) {
    std::vector<double> travelled = numbers(*all[w].data, "displacement");
    if (all[w].query) {  // of every frame
      std::vector<double> at_keyframes;
      for (const double frame : numbers(*all[w].data, "frame")) {
        if (frame < static_cast<double>(travelled.size()))
          at_keyframes.push_back(travelled[static_cast<std::size_t>(frame)]);
      }
      travelled = std::move(at_keyframes);
    }
    if (travelled.size() < 2) continue;
    Series series{.name = all[w].name, .x = upto(travelled.size() - 1), .y = differences(travelled)};
    for (double& step : series.y) step /= unit;
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
  for (const MatchRow& match : run.matches)
    along_m.push_back(query_m[static_cast<std::size_t>(match.query_frame)]);
  chart.series.push_back(walk_style(
      {.name = "query", .x = upto(along_m.size() - 1), .y = differences(along_m)}, chart.series.size()));
  for (const ordered_json& traverse : traverses(run)) {
    along_m = numbers(traverse, "distance_m");
    if (along_m.size() < 2) continue;
    chart.series.push_back(walk_style({.name = "reference " + traverse["name"].get<std::string>(),
                                       .x = upto(along_m.size() - 1),
                                       .y = differences(along_m)},
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
  for (const ordered_json& traverse : traverses(run)) {
    Series series{.name = "reference " + traverse["name"].get<std::string>(),
                  .x = numbers(traverse, "x_m"),
                  .y = numbers(traverse, "y_m"),
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

std::vector<ordered_json> matrix_specs(const RunView& run) {
  std::vector<ordered_json> specs;
  for (const ordered_json& traverse : traverses(run)) {
    if (!traverse.contains("pictures") || traverse["pictures"].empty()) continue;
    const std::vector<double> frames = numbers(traverse, "frame");
    const std::vector<double> keyframe = upto(frames.size());
    ordered_json matches = ordered_json::array(), truth = ordered_json::array();
    for (std::size_t q = 0; q < run.matches.size(); ++q) {
      const MatchRow& match = run.matches[q];
      ordered_json reference;
      if (match.reference_frame && match.traverse == traverse["name"])
        reference = std::lround(interpolated(frames, keyframe, static_cast<double>(*match.reference_frame)));
      matches.push_back({{"query", q},
                         {"frame", match.query_frame},
                         {"time_s", rounded(match.query_time_s)},
                         {"reference", reference},
                         {"score", rounded(match.score)},
                         {"accepted", match.accepted}});
      if (run.truth == nullptr) continue;
      const auto frame = true_frame(run.truth->truth, match.query_frame);
      truth.push_back(frame ? rounded(interpolated(frames, keyframe, *frame)) : nullptr);
    }
    ordered_json spec{{"traverse", traverse["name"]},     {"queries", run.matches.size()},
                      {"references", frames.size()},      {"reference_frames", traverse["frame"]},
                      {"pictures", traverse["pictures"]}, {"matches", std::move(matches)}};
    if (run.truth != nullptr) spec["truth"] = std::move(truth);
    specs.push_back(std::move(spec));
  }
  return specs;
}

ordered_json strip_spec(const RunView& run) {
  ordered_json spec{{"unit", "m"}, {"pairs", ordered_json::array()}};
  if (run.truth != nullptr && run.truth->unit == place::ErrorUnit::kFrames) spec["unit"] = "frames";
  if (!run.data.contains("pairs")) return spec;
  for (const ordered_json& stored : run.data["pairs"]) {
    const auto q = stored["keyframe"].get<std::size_t>();
    if (q >= run.matches.size() || !run.matches[q].reference_frame) continue;
    const MatchRow& match = run.matches[q];
    ordered_json pair = stored;
    pair["query_frame"] = match.query_frame;
    pair["time_s"] = rounded(match.query_time_s);
    pair["reference_frame"] = *match.reference_frame;
    pair["reference_time_s"] = rounded(match.reference_time_s);
    pair["score"] = rounded(match.score);
    pair["accepted"] = match.accepted;
    if (run.truth != nullptr && run.truth->errors[q].error) {
      pair["error"] = rounded(*run.truth->errors[q].error);
      pair["right"] = *run.truth->errors[q].error <= run.truth->tolerance;
    }
    spec["pairs"].push_back(std::move(pair));
  }
  return spec;
}

}  // namespace retrace
