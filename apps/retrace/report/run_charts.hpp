#pragma once

#include "matches_file.hpp"
#include "report/chart.hpp"
#include "report/run_report.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace retrace {

/// What the figures of a run's report are drawn from.
struct RunView {
  const std::filesystem::path& folder;
  const std::vector<MatchRow>& matches;
  const nlohmann::ordered_json& data;  ///< see run_data.hpp; may be empty
  const RunTruth* truth;               ///< null before the run is evaluated
};

// Each gives none where the run has not what it would show.
std::optional<Chart> precision_recall_chart(const RunTruth& truth);
std::optional<Chart> error_chart(const RunView& run);
std::optional<Chart> score_chart(const RunView& run);
/// Displacement a second of both walks, over time (SSS Fig. 6).
std::optional<Chart> speed_chart(const RunView& run);
/// Displacement between neighbouring keyframes of both walks (SSS Fig. 7).
std::optional<Chart> keyframe_chart(const RunView& run);
/// The same in metres, where both walks have true distances.
std::optional<Chart> spacing_chart(const RunView& run);
std::optional<Chart> map_chart(const RunView& run);
/// What matrix.js reads, for each traverse that has pictures.
std::vector<nlohmann::ordered_json> matrix_specs(const RunView& run);
/// What strip.js reads.
nlohmann::ordered_json strip_spec(const RunView& run);

}  // namespace retrace
