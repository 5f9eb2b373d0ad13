#pragma once

#include "command.hpp"
#include "sweep_grid.hpp"
#include "truth_options.hpp"

#include <string>
#include <vector>

namespace retrace {

struct SweepOptions {
  place::Settings settings;
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
/// sweep that is killed goes on from there. Without motion, and with `every` neither given nor varied, as
/// many keyframes are kept as with the first motion. False if the user stopped it. Throws `vo::Error` for
/// walks and truth that cannot be read, or a setting that has an effect in no cell.
bool run_sweep(const SweepOptions& options, const std::vector<Axis>& axes, SweepResults& results);

}  // namespace retrace
