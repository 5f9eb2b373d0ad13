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
};

struct SweepCallbacks {
  /// Receives all results after every few cells, so that an interrupted sweep can continue from there.
  std::function<void(const SweepResults&)> keep;
  /// Receives one line for each set of cells that cannot be run.
  std::function<void(const std::string&)> warn;
  vo::ProgressCallback progress;
};

/// Throws `vo::Error` unless every cell's settings are in range and compatible (`resolve`), and every setting
/// of `base` has an effect in some cell.
void check_sweep(const Settings& base, const std::vector<SweepAxis>& axes);

/// Finds the query on the reference with the settings of every cell that is not in `results`, and adds the
/// outcome (SSS 4.2, Fig. 8). Each walk is read once for each descriptor, and a cost matrix is computed once
/// for all cells that share it. Without motion, and with `every` neither given nor varied, as many keyframes
/// are kept as with the first other motion, so that densities are equal. Returns false if `progress` stopped
/// it. Throws what the readers throw, and `vo::Error` for settings as in `check_sweep`.
bool sweep(const SweepInput& input, const std::vector<SweepAxis>& axes, SweepResults& results,
           const SweepCallbacks& callbacks = {});

}  // namespace place
