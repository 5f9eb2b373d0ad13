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

/// Reads a recording, keeping what is asked for: `vo::read_walk`, or a walk that lies in memory.
using WalkReader = std::function<vo::Walk(const vo::WalkOptions&)>;

/// Two recordings, the truth about them, and the settings that hold in every cell.
struct SweepInput {
  WalkReader query;      ///< the walk to be found
  WalkReader reference;  ///< the walk it is found on
  GroundTruth truth;
  Tolerance tolerance;
  Settings settings;
};

struct SweepCallbacks {
  /// Given all results after every few cells, so that a sweep that is killed can go on from there.
  std::function<void(const SweepResults&)> keep;
  /// Given one line for each set of cells that cannot be run.
  std::function<void(const std::string&)> warn;
  vo::ProgressCallback progress;
};

/// Throws `vo::Error` unless every cell's settings are in range and go together (`resolve`), and every
/// setting of `base` has an effect in some cell.
void check_sweep(const Settings& base, const std::vector<SweepAxis>& axes);

/// Finds the query on the reference with the settings of every cell that `results` has not, and adds what
/// came out (SSS 4.2, Fig. 8). Each walk is read once for each descriptor, and a cost matrix is computed once
/// for all cells that share it. Without motion, and with `every` neither given nor varied, as many keyframes
/// are kept as with the first other motion, so that densities are equal. False if `progress` stopped it.
/// Throws what the readers throw, and `vo::Error` for settings as in `check_sweep`.
bool sweep(const SweepInput& input, const std::vector<SweepAxis>& axes, SweepResults& results,
           const SweepCallbacks& callbacks = {});

}  // namespace place
