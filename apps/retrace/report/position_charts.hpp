#pragma once

#include "report/chart.hpp"
#include "report/odometry_view.hpp"

#include <optional>

namespace retrace {

// Each returns none if the walk lacks what it would show.
/// The trajectory, aligned with the truth if there is one.
std::optional<Chart> trajectory_chart(const OdometryView& walk);
/// Error against distance with its standard deviation (PVO Fig. 7).
std::optional<Chart> position_error_chart(const OdometryView& walk);
std::optional<Chart> heading_error_chart(const OdometryView& walk);

}  // namespace retrace
