#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <place/match/match.hpp>

namespace retrace {

/// What later commands need of a run's summary.json.
struct RunSummary {
  std::string query, route;                     ///< as given to `retrace localise`; empty if not known
  std::size_t query_frames = 0;                 ///< 0 if not known
  std::optional<double> query_start_utc_s;      ///< when the walk began
  std::vector<std::int64_t> frames_after_gaps;  ///< of the query, where its recording was interrupted
};

/// Reads it; what is missing, the file itself included, is left out.
RunSummary read_run_summary(const std::filesystem::path& folder);

/// The matches before which the query's recording was interrupted.
std::vector<std::size_t> gaps_of(const RunSummary& summary, const std::vector<place::Match>& matches);

}  // namespace retrace
