#pragma once

#include "command.hpp"
#include "settings.hpp"
#include "sweep_grid.hpp"
#include "truth_options.hpp"

#include <string>
#include <vector>

namespace retrace {

struct SweepOptions {
  Settings settings;
  CommonOptions common;
  TruthOptions truth;
  std::string query;
  std::string reference;
  std::string output;
  std::vector<std::string> motions{"sad", "none"};
  std::vector<std::string> lengths{"5", "10", "20", "40"};
  std::vector<std::string> ranges{"0", "0.1", "0.2", "0.4", "0.6"};
  std::vector<std::string> vary;
};

/// Runs the cells that `results` has not, and adds them; sweep.csv is renewed after every few, so that a
/// sweep that is killed goes on from there. `every_given`: the user says how many frames lie between
/// keyframes without motion; otherwise there are as many keyframes as with the first motion. False if the
/// user stopped it. Throws `vo::Error` for walks and truth that cannot be read.
bool run_sweep(const SweepOptions& options, const std::vector<Axis>& axes, SweepResults& results,
               bool every_given);

}  // namespace retrace
