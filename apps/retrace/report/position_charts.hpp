#pragma once

#include "report/chart.hpp"
#include "report/odometry_view.hpp"

#include <optional>

namespace retrace {

// Each gives none where the walk has not what it would show.
/// The trajectory, laid on the truth where there is one.
std::optional<Chart> trajectory_chart(const OdometryView& walk);
/// Error against distance with its standard deviation (PVO Fig. 7).
std::optional<Chart> position_error_chart(const OdometryView& walk);
std::optional<Chart> heading_error_chart(const OdometryView& walk);

}  // namespace retrace
