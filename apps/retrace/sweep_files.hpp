#pragma once

#include "command.hpp"
#include "truth_options.hpp"

#include <string>
#include <vector>

#include <place/evaluation/sweep.hpp>

namespace retrace {

struct SweepOptions {
  place::Settings settings;
  CommonOptions common;
  TruthOptions truth;
  std::vector<std::string> query;      ///< files that are one walk
  std::vector<std::string> reference;  ///< the same
  std::string output;
  std::vector<std::string> motions{"sad", "none"};
  std::vector<std::string> lengths{"5", "10", "20", "40"};
  std::vector<std::string> ranges{"0", "0.1", "0.2", "0.4", "0.6"};
  std::vector<std::string> vary;
};

/// Earlier results, if the output folder holds the same sweep; prepares the folder for more. Throws
/// `vo::Error` if the folder holds another sweep and `force` was not given.
place::SweepResults resume_sweep(const SweepOptions& options, const std::vector<place::SweepAxis>& axes);

/// Writes sweep.csv.
void write_sweep_csv(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const place::SweepResults& results);

/// Writes report.html and heat_map.png.
void write_sweep_report(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                        const place::SweepResults& results);

/// The best cell of each motion and of all, on standard output; as JSON every cell.
void print_sweep(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                 const place::SweepResults& results);

}  // namespace retrace
