#pragma once

#include "benchmark_files.hpp"
#include "sweep_files.hpp"

#include <string>
#include <vector>

#include <place/evaluation/sweep.hpp>

namespace retrace {

/// One pair's sweep, with its own folder; all that is there, without a list.
struct PairSweep {
  std::string name;
  SweepOptions options;
  place::GroundTruth truth;
};

/// The sweeps of all pairs: of the list, or of the one pair that was given. Throws `UsageError` unless it is
/// one of both, and complete; `vo::Error` for a list or a truth that cannot be read.
std::vector<PairSweep> pair_sweeps(const SweepOptions& options);

/// Runs the cells of all pairs that one process of several has, and keeps them in files of its own.
void sweep_part(const std::vector<PairSweep>& pairs, const SweepOptions& options,
                const std::vector<place::SweepAxis>& axes);

/// A pair's sweep as a whole: runs what is missing, or with `merge` refuses if anything is; then the report.
SweptPair sweep_pair(const PairSweep& pair, const std::vector<place::SweepAxis>& axes);

}  // namespace retrace
