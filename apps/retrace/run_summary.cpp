#include "run_summary.hpp"

#include "json_file.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace retrace {

RunSummary read_run_summary(const std::filesystem::path& folder) {
  const nlohmann::ordered_json json = read_json_object(folder / "summary.json");
  RunSummary summary{.query = text_in(json, "query").value_or(""),
                     .route = text_in(json, "route").value_or(""),
                     .query_frames = static_cast<std::size_t>(count_in(json, "query_frames").value_or(0)),
                     .query_start_utc_s = number_in(json, "query_start_utc_s"),
                     .frames_after_gaps = {}};
  for (const double frame : numbers_in(json, "query_frames_after_gaps")) {
    if (frame >= 0 && frame < static_cast<double>(summary.query_frames))
      summary.frames_after_gaps.push_back(static_cast<std::int64_t>(frame));
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
