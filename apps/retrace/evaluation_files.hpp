#pragma once

#include "truth_options.hpp"

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include <place/evaluation/bootstrap.hpp>

namespace retrace {

/// Holds a run against the truth (`place::evaluate`) and writes metrics.json, pr.csv, errors.csv and
/// report.html into its folder. Gives the evaluation, and what metrics.json holds. Throws `vo::Error` if
/// there is no such run, or the truth gives none of its keyframes a true place.
std::pair<place::RunEvaluation, nlohmann::ordered_json> evaluate_folder(const std::filesystem::path& folder,
                                                                        const TruthOptions& truth);

/// What errors.csv of an evaluated run holds. Throws `vo::Error` if there is none.
place::TimedQueries read_errors(const std::filesystem::path& folder);

/// Tolerance and unit in metrics.json of an evaluated run. Throws `vo::Error` if there is none.
std::pair<double, std::string> read_tolerance(const std::filesystem::path& folder);

}  // namespace retrace
