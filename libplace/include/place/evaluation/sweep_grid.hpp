#pragma once

#include "place/evaluation/bootstrap.hpp"
#include "place/settings.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace place {

/// A setting and the values it takes.
struct SweepAxis {
  std::string setting;  ///< its name, without dashes
  std::vector<std::string> values;
};

/// A cell of a sweep: one value for each axis.
using SweepCell = std::vector<std::string>;

/// The outcome of a cell.
struct CellResult {
  std::size_t query_keyframes = 0;
  std::size_t reference_keyframes = 0;
  double max_f1 = 0, max_f1_threshold = 0, precision = 0, recall = 0;
  double auc_pr = 0, recall_at_100_precision = 0, recall_at_1 = 0;
  std::string density;   ///< the setting that keyframes are as dense by, and its value: "every=8"
  TimedQueries queries;  ///< the result of each query; empty if read from a file
};

/// None for a cell that cannot be run: a walk without steps, a route shorter than the sequence.
using SweepResults = std::map<SweepCell, std::optional<CellResult>>;

/// Parses `NAME=a,b,c`. Throws `vo::Error` for anything else.
SweepAxis parse_axis(const std::string& text);

/// Every cell, the last axis fastest.
std::vector<SweepCell> all_cells(const std::vector<SweepAxis>& axes);

/// The settings of a cell: `base` with the axes' values. Throws `vo::Error` naming a setting that does not
/// exist, does not affect where places are found, or does not accept its value.
Settings settings_at(const Settings& base, const std::vector<SweepAxis>& axes, const SweepCell& cell);

/// True if the setting changes keyframes or their descriptors, and so the cost matrix.
bool shapes_the_matrix(const std::string& setting);

/// The result with the nine digits of every figure that sweep.csv holds, so that it equals what is read back.
CellResult as_written(CellResult result);

/// sweep.csv: a row for each cell, those of the grid first and in its order.
std::string sweep_csv(const std::vector<SweepAxis>& axes, const SweepResults& results);

/// Reads it back; empty if there is no file. Throws `vo::Error` if it has other axes.
SweepResults read_sweep(const std::filesystem::path& path, const std::vector<SweepAxis>& axes);

}  // namespace place
