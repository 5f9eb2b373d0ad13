#pragma once

#include "comparison.hpp"

#include <optional>
#include <string>

namespace retrace {

/// "0.913 [0.871, 0.942]", without brackets if there is no interval.
std::string with_interval(double value, const std::optional<place::Interval>& interval);

/// The page: figures with their intervals, curves, differences of pairs.
std::string compare_report(const Comparison& comparison);

}  // namespace retrace
