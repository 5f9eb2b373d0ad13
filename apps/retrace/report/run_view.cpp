#include "run_view.hpp"

#include "json_file.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <nlohmann/json.hpp>

#include <place/match/match_io.hpp>
#include <vo/io/csv.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

/// Numbers that a figure may have along an axis: each after the one before, or with it, and small enough that
/// steps between them count.
bool forwards(const std::vector<double>& values) {
  constexpr double kMost = 1e10;
  return std::ranges::all_of(values, [](double value) { return std::abs(value) <= kMost; }) &&
         std::ranges::is_sorted(values);
}

/// The columns of a walk; those are empty that are not of one length or, of frames and times, not in order.
WalkColumns columns(const ordered_json& json, std::string name, bool query) {
  WalkColumns walk{.name = std::move(name),
                   .frame = numbers_in(json, "frame"),
                   .time_s = numbers_in(json, "time_s"),
                   .displacement = numbers_in(json, "displacement"),
                   .distance_m = numbers_in(json, "distance_m"),
                   .x_m = numbers_in(json, "x_m"),
                   .y_m = numbers_in(json, "y_m")};
  const bool frames = forwards(walk.frame) && (walk.frame.empty() || walk.frame.front() >= 0) &&
                      std::ranges::adjacent_find(walk.frame) == walk.frame.end();
  if (!frames) walk.frame.clear();
  // Of each frame of the query, and of each keyframe of a traverse.
  const std::size_t count = query ? walk.displacement.size() : walk.frame.size();
  if (walk.time_s.size() != count || !forwards(walk.time_s)) walk.time_s.clear();
  for (std::vector<double>* column : {&walk.displacement, &walk.distance_m, &walk.x_m, &walk.y_m})
    if (column->size() != count) column->clear();
  if (walk.x_m.size() != walk.y_m.size()) {
    walk.x_m.clear();
    walk.y_m.clear();
  }
  return walk;
}

std::optional<RunCounts> read_counts(const std::filesystem::path& file) {
  const ordered_json json = read_json_object(file);
  if (json.empty()) return {};
  const auto some = [&](const char* name) -> std::optional<std::size_t> {
    const auto number = count_in(json, name);
    if (!number) return {};
    return static_cast<std::size_t>(*number);
  };
  const auto count = [&](const char* name) { return some(name).value_or(0); };
  return RunCounts{.queries = count("queries"),
                   .query_frames = count("query_frames"),
                   .matched = count("matched"),
                   .accepted = count("accepted"),
                   .partial = some("partial"),
                   .partial_accepted = some("partial_accepted"),
                   .sequence_length = some("sequence_length"),
                   .accept_score = number_in(json, "accept_score"),
                   .accept_probability = number_in(json, "accept_probability"),
                   .relative_scale = number_in(json, "relative_scale"),
                   .query = text_in(json, "query").value_or(""),
                   .route = text_in(json, "route").value_or(""),
                   .warnings = texts_in(json, "warnings")};
}

}  // namespace

RunView read_run(const std::filesystem::path& folder, const ordered_json& data, const RunTruth* truth) {
  RunView run{.folder = folder,
              .matches = place::read_matches(folder / "matches.csv"),
              .unit = number_in(data, "unit").value_or(0),
              .counts = read_counts(folder / "summary.json"),
              .data = data,
              .truth = truth,
              .true_frame = {}};
  if (truth != nullptr) {
    for (const place::Match& match : run.matches)
      run.true_frame.push_back(true_frame(truth->truth, match.query_frame));
  }
  if (member(data, "query").is_object()) run.query = columns(data["query"], "query", true);
  const ordered_json& traverses = member(data, "traverses");
  if (traverses.is_array()) {
    for (const ordered_json& traverse : traverses)
      run.traverses.push_back(columns(traverse, text_in(traverse, "name").value_or(""), false));
  }
  return run;
}

std::vector<std::optional<double>> read_true_frames(const std::filesystem::path& folder) {
  const vo::CsvTable table = vo::CsvTable::read(folder / "errors.csv");
  return table.has("true_frame") ? table.optional_numbers("true_frame")
                                 : std::vector<std::optional<double>>();
}

std::optional<double> true_frame(const place::GroundTruth& truth, std::int64_t query_frame) {
  if (truth.pairs) return place::true_reference_frame(*truth.pairs, static_cast<double>(query_frame));
  const auto& along = truth.reference_distance_m;
  if (query_frame >= static_cast<std::int64_t>(truth.query_distance_m.size()) || along.empty()) return {};
  const std::optional<double>& at_m = truth.query_distance_m[static_cast<std::size_t>(query_frame)];
  if (!at_m || *at_m < along.front() || *at_m > along.back()) return {};
  return static_cast<double>(std::ranges::lower_bound(along, *at_m) - along.begin());
}

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

}  // namespace retrace
