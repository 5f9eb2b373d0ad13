#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <place/evaluation/bootstrap.hpp>
#include <place/evaluation/evaluation.hpp>

namespace retrace {

/// A run to compare.
struct ComparedRun {
  std::string name;
  std::string folder;
  place::Evaluation evaluation;
  place::RunBootstrap bootstrap;
};

/// What all runs have in common.
struct Comparison {
  std::vector<ComparedRun> runs;
  double tolerance = 0;
  std::string unit;
  place::BootstrapOptions options;
};

/// Compares evaluated runs, read from their folders, by a paired bootstrap. `names`: one for each, or none
/// for the folders' own. Throws `vo::Error` for a run that was not evaluated, or with another tolerance than
/// the first.
Comparison compare_runs(const std::vector<std::string>& folders, const std::vector<std::string>& names,
                        const place::BootstrapOptions& options);

/// comparison.json: every run's figures with their intervals, and the differences of every pair.
nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace retrace
