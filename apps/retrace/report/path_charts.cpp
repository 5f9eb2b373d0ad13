#include "path_charts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace retrace {
namespace {

/// A path, one point for each query on it.
struct PathPoints {
  std::vector<double> query, reference;
};

/// The traverse that a path runs along: the one with most accepted matches, or the first.
const WalkColumns* main_traverse(const RunView& run) {
  if (run.traverses.empty()) return nullptr;
  std::map<std::string, int> accepted;
  for (const place::Match& match : run.matches) {
    if (match.place && match.accepted) ++accepted[match.place->traverse];
  }
  return &*std::ranges::max_element(run.traverses, {},
                                    [&](const WalkColumns& t) { return accepted[t.name]; });
}

/// The frame of the traverse at which each query is, truly or as accepted; none elsewhere.
std::vector<std::optional<double>> frames_on_path(const RunView& run, const WalkColumns& traverse) {
  if (!run.true_frame.empty()) return run.true_frame;
  std::vector<std::optional<double>> frames;
  for (const place::Match& match : run.matches) {
    const bool here = match.place && match.accepted && match.place->traverse == traverse.name;
    frames.push_back(here ? std::optional(static_cast<double>(match.place->frame)) : std::nullopt);
  }
  return frames;
}

/// From 0 at `first` to 1 at `last`.
double share(double value, double first, double last) {
  return last > first ? (value - first) / (last - first) : 0;
}

/// A path as shares of both walks, by keyframes or by time.
PathPoints path_of(const RunView& run, const WalkColumns& traverse, bool by_time) {
  PathPoints path;
  const std::vector<double> keyframes = upto(traverse.frame.size());
  const std::vector<double>& along = by_time ? traverse.time_s : keyframes;
  if (run.matches.empty() || traverse.frame.size() < 2 || along.size() != traverse.frame.size()) return path;
  const std::vector<std::optional<double>> frames = frames_on_path(run, traverse);
  for (std::size_t q = 0; q < frames.size(); ++q) {
    if (!frames[q]) continue;
    path.query.push_back(by_time ? share(run.matches[q].query_time_s, run.matches.front().query_time_s,
                                         run.matches.back().query_time_s)
                                 : share(static_cast<double>(q), 0, static_cast<double>(frames.size() - 1)));
    path.reference.push_back(
        share(interpolated(traverse.frame, along, *frames[q]), along.front(), along.back()));
  }
  return path;
}

/// Root mean square distance of a path from its best straight line, as a share of the reference.
double off_a_line(const PathPoints& path) {
  const auto n = static_cast<double>(path.query.size());
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < path.query.size(); ++i) {
    x += path.query[i] / n;
    y += path.reference[i] / n;
  }
  for (std::size_t i = 0; i < path.query.size(); ++i) {
    xx += (path.query[i] - x) * (path.query[i] - x);
    xy += (path.query[i] - x) * (path.reference[i] - y);
    yy += (path.reference[i] - y) * (path.reference[i] - y);
  }
  return std::sqrt(std::max(0.0, xx > 0 ? yy - xy * xy / xx : yy) / n);
}

Chart path_plane() {
  return {.title = "path of the query along the route",
          .x_title = "share of the query",
          .y_title = "share of the reference",
          .x_range = std::array{0.0, 1.0},
          .y_range = std::array{0.0, 1.0},
          .size = "tall"};
}

constexpr std::size_t kFewestPoints = 3;  // two are always on a line

bool add_path(Chart& chart, const std::string& name, const PathPoints& path) {
  if (path.query.size() < kFewestPoints) return false;
  Series series = styled({.name = fmt::format("{}: {:.1f} % off a line", name, 100 * off_a_line(path)),
                          .x = path.query,
                          .y = path.reference},
                         chart.series.size());
  series.mark.clear();
  chart.series.push_back(std::move(series));
  return true;
}

/// What a place is measured by: metres if the route is surveyed, else frames of the reference.
struct PlaceScale {
  std::string title;
  std::vector<double> at;  // of each keyframe of the traverse
};

PlaceScale place_scale(const WalkColumns& traverse) {
  if (!traverse.distance_m.empty() &&
      std::ranges::all_of(traverse.distance_m, [](double d) { return std::isfinite(d); }))
    return {"place, m along the route", traverse.distance_m};
  return {"place, frames of the reference", traverse.frame};
}

/// The places of query keyframes with truth, and their times.
struct QueryPlaces {
  std::vector<double> time_s, at;
};

QueryPlaces query_places(const RunView& run, const WalkColumns& traverse, const PlaceScale& scale) {
  QueryPlaces places;
  for (std::size_t q = 0; q < run.true_frame.size(); ++q) {
    if (!run.true_frame[q]) continue;
    places.time_s.push_back(run.matches[q].query_time_s);
    places.at.push_back(interpolated(traverse.frame, scale.at, *run.true_frame[q]));
  }
  return places;
}

/// The same number of places, evenly in time.
std::vector<double> evenly_in_time(const std::vector<double>& time_s, const std::vector<double>& at) {
  std::vector<double> places;
  const auto last = static_cast<double>(time_s.size() - 1);
  for (std::size_t i = 0; i < time_s.size(); ++i)
    places.push_back(
        interpolated(time_s, at, std::lerp(time_s.front(), time_s.back(), static_cast<double>(i) / last)));
  return places;
}

/// How unevenly places lie: deviation of their spacing over its mean.
double unevenness(const std::vector<double>& places) {
  double sum = 0, square = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double step = places[i] - places[i - 1];
    sum += step;
    square += step * step;
  }
  const auto n = static_cast<double>(places.size() - 1);
  return sum > 0 ? std::sqrt(std::max(0.0, square * n / (sum * sum) - 1)) : 0;
}

/// A row of places, above those before it.
void add_places(Chart& chart, const std::string& name, const std::vector<double>& places) {
  const std::size_t row = chart.series.size();
  chart.y_names.push_back(name);
  Series series =
      styled({.name = fmt::format("{}: spacing varies by {:.0f} %", name, 100 * unevenness(places)),
              .x = places,
              .y = std::vector<double>(places.size(), static_cast<double>(row + 1)),
              .line = false},
             row);
  series.size_px = 3;
  chart.series.push_back(std::move(series));
}

std::optional<Chart> with_rows(Chart chart) {
  if (chart.series.empty()) return {};
  chart.y_range = {0.4, static_cast<double>(chart.series.size()) + 0.6};
  return chart;
}

Chart place_rows() {
  return {.title = "where keyframes lie on the route", .y_title = "", .zoomable = true, .size = ""};
}

}  // namespace

std::optional<Chart> straightness_chart(const RunView& run) {
  const WalkColumns* traverse = main_traverse(run);
  if (traverse == nullptr) return {};
  Chart chart = path_plane();
  if (!add_path(chart, "by time, as fixed sampling has it", path_of(run, *traverse, true))) return {};
  add_path(chart, "by keyframes", path_of(run, *traverse, false));
  return chart;
}

std::optional<Chart> path_chart(const std::vector<NamedRun>& runs) {
  Chart chart = path_plane();
  for (const auto& [name, run] : runs) {
    if (const WalkColumns* traverse = main_traverse(*run))
      add_path(chart, name, path_of(*run, *traverse, false));
  }
  if (chart.series.empty()) return {};
  return chart;
}

std::optional<Chart> sampling_chart(const RunView& run) {
  const WalkColumns* traverse = main_traverse(run);
  if (traverse == nullptr || run.true_frame.empty() || traverse->frame.size() < kFewestPoints ||
      traverse->time_s.size() != traverse->frame.size())
    return {};
  const PlaceScale scale = place_scale(*traverse);
  const QueryPlaces query = query_places(run, *traverse, scale);
  if (query.at.size() < kFewestPoints) return {};
  Chart chart = place_rows();
  chart.x_title = scale.title;
  add_places(chart, "reference, keyframes", scale.at);
  add_places(chart, "query, keyframes", query.at);
  add_places(chart, "reference, by time", evenly_in_time(traverse->time_s, scale.at));
  add_places(chart, "query, by time", evenly_in_time(query.time_s, query.at));
  return with_rows(std::move(chart));
}

std::optional<Chart> sampling_chart(const std::vector<NamedRun>& runs) {
  Chart chart = place_rows();
  for (const auto& [name, run] : runs) {
    const WalkColumns* traverse = main_traverse(*run);
    if (traverse == nullptr || traverse->frame.size() < kFewestPoints) continue;
    const PlaceScale scale = place_scale(*traverse);
    // Places in metres and in frames do not go together.
    if (!chart.x_title.empty() && chart.x_title != scale.title) continue;
    const QueryPlaces query = query_places(*run, *traverse, scale);
    if (query.at.size() < kFewestPoints) continue;
    chart.x_title = scale.title;
    add_places(chart, name + ", reference", scale.at);
    add_places(chart, name + ", query", query.at);
  }
  return with_rows(std::move(chart));
}

}  // namespace retrace
