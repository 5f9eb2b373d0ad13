#pragma once

#include <string>
#include <vector>

#include <place/evaluation/bootstrap.hpp>
#include <place/evaluation/evaluation.hpp>

namespace retrace {

/// A run as it is compared.
struct ComparedRun {
  std::string name;
  std::string folder;
  place::Evaluation evaluation;
  place::RunBootstrap bootstrap;
};

/// What all of them have in common.
struct Comparison {
  std::vector<ComparedRun> runs;
  double tolerance = 0;
  std::string unit;
  place::BootstrapOptions options;
};

/// "0.913 [0.871, 0.942]", without brackets where there is no interval.
std::string with_interval(double value, const std::optional<place::Interval>& interval);

/// The page: figures with their intervals, curves, differences by pairs.
std::string compare_report(const Comparison& comparison);

}  // namespace retrace
