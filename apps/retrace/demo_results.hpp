#pragma once

#include "demo_runs.hpp"

#include <cstdint>
#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace retrace {

/// The results of a demo.
struct DemoResults {
  std::uint64_t seed = 1;
  double length_m = 0;
  const DemoRun& vanilla;
  const DemoRun& normalised;
  std::filesystem::path overview;
  double seconds = 0;  ///< duration
};

nlohmann::ordered_json demo_json(const DemoResults& results);

/// The same as a table, on standard output.
void print_demo(const DemoResults& results);

}  // namespace retrace
