#include "run_view.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include <nlohmann/json.hpp>

#include <place/match/match_io.hpp>

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
              .truth = truth};
  if (data.contains("query")) run.query = columns(data["query"], "query");
  if (data.contains("traverses")) {
    for (const ordered_json& traverse : data["traverses"])
      run.traverses.push_back(columns(traverse, traverse["name"].get<std::string>()));
  }
  return run;
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
