#pragma once

#include "report/run_view.hpp"

#include <optional>
#include <string>
#include <vector>

namespace retrace {

/// A cost matrix against one traverse.
struct MatrixFigure {
  std::string traverse;
  std::string json;  ///< what matrix.js reads
};

/// One for each traverse that has pictures.
std::vector<MatrixFigure> matrix_figures(const RunView& run);
/// What strip.js reads, as JSON; none without pairs of pictures.
std::optional<std::string> strip_json(const RunView& run);

}  // namespace retrace
