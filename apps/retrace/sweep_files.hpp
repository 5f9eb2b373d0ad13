#pragma once

#include "sweep_run.hpp"

#include <vector>

namespace retrace {

/// What was done before, if the output folder holds the same sweep; with it the folder is ready for more.
/// Throws `vo::Error` if the folder holds another sweep and `force` was not given.
SweepResults resume_sweep(const SweepOptions& options, const std::vector<Axis>& axes);

/// Writes report.html and heat_map.png.
void write_sweep_report(const SweepOptions& options, const std::vector<Axis>& axes,
                        const SweepResults& results);

/// The best cell of each motion and of all, on standard output; as JSON every cell.
void print_sweep(const SweepOptions& options, const std::vector<Axis>& axes, const SweepResults& results);

}  // namespace retrace
