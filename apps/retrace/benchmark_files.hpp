#pragma once

#include "sweep_files.hpp"

#include <string>
#include <vector>

namespace retrace {

/// A finished sweep of one pair of walks.
struct SweptPair {
  std::string name;  ///< of the pair
  place::SweepResults results;
  std::vector<place::ComparedMethod> methods;
};

/// Writes benchmark.csv and .json, a row for each pair and method, and report.html, the page about all pairs,
/// into the output folder.
void write_benchmark(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const std::vector<SweptPair>& pairs);

/// The table of methods and pairs on standard output; as JSON what benchmark.json holds.
void print_benchmark(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const std::vector<SweptPair>& pairs);

}  // namespace retrace
