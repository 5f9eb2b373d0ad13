#pragma once

#include "report/chart.hpp"
#include "report/odometry_view.hpp"

#include <optional>

namespace retrace {

// Each gives none where the walk has not what it would show.
/// Orientation with thresholds and steps, left and right (PVO Fig. 3).
std::optional<Chart> gait_chart(const OdometryView& walk);
std::optional<Chart> activity_chart(const OdometryView& walk);
std::optional<Chart> heading_chart(const OdometryView& walk);
/// Speed, with what it comes from where visual odometry is lost shaded; with the truth's (SSS Fig. 9).
std::optional<Chart> speed_chart(const OdometryView& walk);
/// Matches of each frame, where too few shaded.
std::optional<Chart> matches_chart(const OdometryView& walk);

}  // namespace retrace
