#pragma once

#include "place/evaluation/run_evaluation.hpp"
#include "place/evaluation/sweep_grid.hpp"
#include "place/settings.hpp"

#include <functional>
#include <string>
#include <vector>

#include <vo/base/progress.hpp>
#include <vo/odometry.hpp>

namespace place {

/// Reads a recording, keeping what is asked for: `vo::read_walk`, or a walk in memory.
using WalkReader = std::function<vo::Walk(const vo::WalkOptions&)>;

/// Two recordings, their truth, and the settings common to all cells.
struct SweepInput {
  WalkReader query;      ///< the walk to be found
  WalkReader reference;  ///< the walk it is found on
  GroundTruth truth;
  Tolerance tolerance;
  Settings settings;
  bool equal_keyframes = false;  ///< see `sweep`
};

struct SweepCallbacks {
  /// Receives all results after every few cells, so that an interrupted sweep can continue from there.
  std::function<void(const SweepResults&)> keep;
  /// Receives one line for each set of cells that cannot be run.
  std::function<void(const std::string&)> warn;
  vo::ProgressCallback progress;
};

/// Throws `vo::Error` unless every cell's settings are in range and compatible (`resolve`), and every setting
/// of `base` has an effect in some cell; with `equal_keyframes`, also if an axis is a density, or none
/// affects how walks are sampled.
void check_sweep(const Settings& base, const std::vector<SweepAxis>& axes, bool equal_keyframes = false);

/// Finds the query on the reference with the settings of every cell that is not in `results`, and adds the
/// outcome (SSS 4.2, Fig. 8). Each walk is read once for all cells that keep the same of it, and a cost
/// matrix is computed once for all cells that share it.
///
/// Without motion, and with `every` neither given nor varied, as many frames are left out that there are
/// about as many keyframes as with the first other motion. `every` is a whole number, so this is not exact.
/// With `input.equal_keyframes`, `sampling-n` and `spacing-m` of all other cells are then multiplied until
/// both walks together have as many keyframes as without motion, or as in the first cell if every cell has
/// motion, within 5 %; cells that cannot are not run. Returns false if `progress` stopped it. Throws what the
/// readers throw, and `vo::Error` for settings as in `check_sweep`.
bool sweep(const SweepInput& input, const std::vector<SweepAxis>& axes, SweepResults& results,
           const SweepCallbacks& callbacks = {});

/// The same for some of the cells.
bool run_cells(const SweepInput& input, const std::vector<SweepAxis>& axes,
               const std::vector<SweepCell>& cells, SweepResults& results,
               const SweepCallbacks& callbacks = {});

}  // namespace place
