#pragma once

#include "report/chart.hpp"
#include "report/odometry_view.hpp"

#include <optional>

namespace retrace {

// Each returns none if the walk lacks what it would show.
/// Orientation with thresholds and steps, left and right (PVO Fig. 3).
std::optional<Chart> gait_chart(const OdometryView& walk);
std::optional<Chart> activity_chart(const OdometryView& walk);
std::optional<Chart> heading_chart(const OdometryView& walk);
/// Speed, shaded by its source where visual odometry is lost; with the true speed (SSS Fig. 9).
std::optional<Chart> speed_chart(const OdometryView& walk);
/// The same with visual odometry in one unit throughout, so that its jumps of scale are seen (SSS Fig. 9);
/// none without visual odometry.
std::optional<Chart> scale_jumps_chart(const OdometryView& walk);
/// Matches of each frame, shaded where there are too few.
std::optional<Chart> matches_chart(const OdometryView& walk);

}  // namespace retrace
