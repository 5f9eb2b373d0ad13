#pragma once

#include "matches_file.hpp"
#include "report/run_report.hpp"

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

namespace retrace {

/// What the figures of a run's report are drawn from.
struct RunView {
  const std::filesystem::path& folder;
  const std::vector<MatchRow>& matches;
  const nlohmann::ordered_json& data;  ///< see run_data.hpp; may be empty
  const RunTruth* truth;               ///< null before the run is evaluated
};

/// A column of the run's data; NaN for null.
std::vector<double> numbers(const nlohmann::ordered_json& json, const char* name);

/// The traverses in the run's data.
const nlohmann::ordered_json& traverses(const RunView& run);

/// 0, 1, ... count - 1.
std::vector<double> upto(std::size_t count);

/// y at `at`, linear between the points of increasing x, as at the ends outside. At least one point.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at);

}  // namespace retrace
