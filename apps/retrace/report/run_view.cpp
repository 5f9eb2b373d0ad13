#include "run_view.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include <nlohmann/json.hpp>

#include <place/match/match_io.hpp>
#include <vo/io/csv.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

std::vector<double> numbers(const ordered_json& json, const char* name) {
  std::vector<double> values;
  if (!json.contains(name)) return values;
  for (const ordered_json& value : json[name])
    values.push_back(value.is_number() ? value.get<double>() : NAN);
  return values;
}

WalkColumns columns(const ordered_json& json, std::string name) {
  return {.name = std::move(name),
          .frame = numbers(json, "frame"),
          .time_s = numbers(json, "time_s"),
          .displacement = numbers(json, "displacement"),
          .distance_m = numbers(json, "distance_m"),
          .x_m = numbers(json, "x_m"),
          .y_m = numbers(json, "y_m")};
}

std::optional<double> number_in(const ordered_json& json, const char* name) {
  if (!json.contains(name) || !json[name].is_number()) return {};
  return json[name].get<double>();
}

std::optional<RunCounts> read_counts(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) return {};
  const ordered_json json = ordered_json::parse(stream, nullptr, false);
  if (!json.is_object()) return {};
  const auto count = [&](const char* name) { return json.value(name, std::size_t{0}); };
  RunCounts counts{.queries = count("queries"),
                   .query_frames = count("query_frames"),
                   .matched = count("matched"),
                   .accepted = count("accepted"),
                   .partial = count("partial"),
                   .partial_accepted = count("partial_accepted"),
                   .sequence_length = count("sequence_length"),
                   .accept_score = number_in(json, "accept_score"),
                   .accept_probability = number_in(json, "accept_probability"),
                   .relative_scale = json.value("relative_scale", 1.0),
                   .query = json.value("query", std::string{}),
                   .route = json.value("route", std::string{})};
  for (const auto& warning : json.value("warnings", ordered_json::array()))
    counts.warnings.push_back(warning.get<std::string>());
  return counts;
}

}  // namespace

RunView read_run(const std::filesystem::path& folder, const ordered_json& data, const RunTruth* truth) {
  RunView run{.folder = folder,
              .matches = place::read_matches(folder / "matches.csv"),
              .unit = data.value("unit", 0.0),
              .counts = read_counts(folder / "summary.json"),
              .data = data,
              .truth = truth,
              .true_frame = {}};
  if (truth != nullptr) {
    for (const place::Match& match : run.matches)
      run.true_frame.push_back(true_frame(truth->truth, match.query_frame));
  }
  if (data.contains("query")) run.query = columns(data["query"], "query");
  if (data.contains("traverses")) {
    for (const ordered_json& traverse : data["traverses"])
      run.traverses.push_back(columns(traverse, traverse["name"].get<std::string>()));
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
