#pragma once

#include "command.hpp"
#include "truth_options.hpp"

#include <string>
#include <vector>

#include <place/evaluation/sweep_methods.hpp>

namespace retrace {

struct SweepOptions {
  place::Settings settings;
  CommonOptions common;
  TruthOptions truth;
  std::vector<std::string> query;      ///< files that are one walk
  std::vector<std::string> reference;  ///< the same
  std::string output;
  std::vector<std::string> motions{"sad", "none"};
  std::vector<std::string> lengths;    ///< keyframes; 5, 10, 20, 40 if neither these
  std::vector<std::string> lengths_m;  ///< nor these are given
  std::vector<std::string> ranges{"0", "0.1", "0.2", "0.4", "0.6"};
  std::vector<std::string> vary;
  std::vector<std::string> compare{"motion"};  ///< axes whose values make a method
  bool equal_keyframes = false;
};

/// Earlier results, if the output folder holds the same sweep; prepares the folder for more. Throws
/// `vo::Error` if the folder holds another sweep and `force` was not given.
place::SweepResults resume_sweep(const SweepOptions& options, const std::vector<place::SweepAxis>& axes);

/// Writes sweep.csv.
void write_sweep_csv(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const place::SweepResults& results);

/// Writes report.html, heat_map.png and methods.json, the fair table.
void write_sweep_report(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                        const place::SweepResults& results,
                        const std::vector<place::ComparedMethod>& methods);

/// The fair table and the best cell of all, on standard output; as JSON also every cell.
void print_sweep(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                 const place::SweepResults& results, const std::vector<place::ComparedMethod>& methods);

}  // namespace retrace
