#include "run_summary.hpp"

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

namespace retrace {

RunSummary read_run_summary(const std::filesystem::path& folder) {
  std::ifstream file(folder / "summary.json");
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  RunSummary summary;
  if (!json.is_object()) return summary;
  const auto has = [&](const char* name, auto of_type) { return json.contains(name) && of_type(json[name]); };
  const auto is_text = [](const nlohmann::json& value) { return value.is_string(); };
  if (has("query", is_text)) summary.query = json["query"];
  if (has("route", is_text)) summary.route = json["route"];
  if (has("query_frames", [](const auto& value) { return value.is_number_unsigned(); }))
    summary.query_frames = json["query_frames"];
  if (has("query_start_utc_s", [](const auto& value) { return value.is_number(); }))
    summary.query_start_utc_s = json["query_start_utc_s"].get<double>();
  if (has("query_frames_after_gaps", [](const auto& value) { return value.is_array(); })) {
    for (const nlohmann::json& frame : json["query_frames_after_gaps"])
      if (frame.is_number_integer()) summary.frames_after_gaps.push_back(frame);
  }
  return summary;
}

std::vector<std::size_t> gaps_of(const RunSummary& summary, const std::vector<place::Match>& matches) {
  std::vector<std::size_t> gaps;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (std::ranges::find(summary.frames_after_gaps, matches[i].query_frame) !=
        summary.frames_after_gaps.end())
      gaps.push_back(i);
  }
  return gaps;
}

}  // namespace retrace
