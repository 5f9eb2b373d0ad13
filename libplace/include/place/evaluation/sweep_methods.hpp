#pragma once

#include "place/evaluation/bootstrap.hpp"
#include "place/evaluation/sweep.hpp"

#include <optional>
#include <string>
#include <vector>

namespace place {

/// A cell with the uncertainty of its max-F1.
struct UncertainCell {
  SweepCell cell;
  CellResult result;
  std::optional<Interval> interval;  ///< of max-F1; none if the walk is a single segment
};

/// A method of a fair comparison: the same values on the compared axes, at its best over all others.
struct ComparedMethod {
  SweepCell values;             ///< on the compared axes, in their order
  UncertainCell best;           ///< the highest max-F1, the first among equals
  UncertainCell standard;       ///< see `standard_cell`
  std::size_t with_truth = 0;   ///< queries of the best cell with a true place
  std::size_t baseline = 0;     ///< the first method that has its values but for the first; perhaps itself
  PairedDifference difference;  ///< of its best from the baseline's
};

/// The cell in which every axis that is not `compared` has its default, or its first value if it lacks that.
SweepCell standard_cell(const std::vector<SweepAxis>& axes, const std::vector<std::string>& compared,
                        SweepCell cell);

/// Throws `vo::Error` for a name that is no axis.
void check_compared(const std::vector<SweepAxis>& axes, const std::vector<std::string>& compared);

/// Compares the methods of a finished sweep, each at its best and at the default, by one paired bootstrap
/// (`bootstrap`) of all these cells. The best is chosen on the walk that it is judged on, so its interval is
/// too high by what the choice gained; with as many cells for each method that favours none. `compared`:
/// names of axes whose values make a method. `results`: of `sweep`; cells read from a file are run again, as
/// their queries are needed, so nothing changes but time. Methods whose default cell could not be run are
/// left out, with a warning; empty if `progress` stopped it. Throws as `check_compared` does.
std::vector<ComparedMethod> compare_methods(const SweepInput& input, const std::vector<SweepAxis>& axes,
                                            const std::vector<std::string>& compared,
                                            const SweepResults& results, const SweepCallbacks& callbacks = {},
                                            const BootstrapOptions& options = {});

}  // namespace place
