#pragma once

#include "report/chart.hpp"
#include "report/run_view.hpp"

#include <optional>

namespace retrace {

Chart precision_recall_chart(const RunTruth& truth);
/// The share of right matches against their probability; none without probabilities.
std::optional<Chart> reliability_chart(const RunTruth& truth);

// Each returns none if the run lacks what it would show.
std::optional<Chart> error_chart(const RunView& run);
std::optional<Chart> score_chart(const RunView& run);
/// Displacement per second of both walks, over time.
std::optional<Chart> speed_chart(const RunView& run);
/// Displacement between neighbouring keyframes of both walks.
std::optional<Chart> keyframe_chart(const RunView& run);
/// The same in metres, if both walks have true distances.
std::optional<Chart> spacing_chart(const RunView& run);
std::optional<Chart> map_chart(const RunView& run);

}  // namespace retrace
