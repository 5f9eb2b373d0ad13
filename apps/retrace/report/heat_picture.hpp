#pragma once

#include "report/page.hpp"

#include <cstdint>
#include <vector>

namespace retrace {

/// A PNG of tables side by side, each cell shaded by its value, with the value in it. All share one scale.
std::vector<std::uint8_t> heat_picture(const std::vector<HeatTable>& tables);

}  // namespace retrace
