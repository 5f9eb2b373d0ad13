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
  SweepCell values;    ///< on the compared axes, in their order
  UncertainCell best;  ///< the highest max-F1, the first among equals
  UncertainCell
      standard;  ///< with the default of every other axis, or its first value if it lacks the default
  std::size_t with_truth = 0;   ///< queries of the best cell with a true place
  PairedDifference difference;  ///< of its best from the first method's best
};

/// The cell in which the axes that are not `compared` have their defaults.
SweepCell standard_cell(const std::vector<SweepAxis>& axes, const std::vector<std::string>& compared,
                        SweepCell cell);

/// Throws `vo::Error` for a name that is no axis.
void check_compared(const std::vector<SweepAxis>& axes, const std::vector<std::string>& compared);

/// Compares the methods of a finished sweep, each at its best and at the default, by one paired bootstrap
/// (`bootstrap`) of all these cells. The best is chosen on the walk that it is judged on, so its interval is
/// too high by what the choice gained; with as many cells for each method that favours none. `compared`:
/// names of axes whose values make a method. `results`: of `sweep`; cells read from a file are run again, as
/// their queries are needed, so nothing changes but time. Methods without a cell that could be run are left
/// out; empty if `progress` stopped it. Throws as `check_compared` does.
std::vector<ComparedMethod> compare_methods(const SweepInput& input, const std::vector<SweepAxis>& axes,
                                            const std::vector<std::string>& compared,
                                            const SweepResults& results, const SweepCallbacks& callbacks = {},
                                            const BootstrapOptions& options = {});

}  // namespace place
