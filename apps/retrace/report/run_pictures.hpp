#pragma once

#include "report/run_view.hpp"

#include <vector>

#include <nlohmann/json.hpp>

namespace retrace {

/// What matrix.js reads, for each traverse that has pictures.
std::vector<nlohmann::ordered_json> matrix_specs(const RunView& run);
/// What strip.js reads.
nlohmann::ordered_json strip_spec(const RunView& run);

}  // namespace retrace
