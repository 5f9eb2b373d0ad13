#pragma once

#include "truth_options.hpp"

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include <place/evaluation/bootstrap.hpp>

namespace retrace {

/// The page of a run's evaluation: its report, or, of a followed walk, a page beside the one that plays it.
std::filesystem::path evaluation_page(const std::filesystem::path& folder);

/// Compares a run with the truth (`place::evaluate`) and writes metrics.json, pr.csv, errors.csv and
/// `evaluation_page` into its folder. Returns the evaluation and the contents of metrics.json. Throws
/// `vo::Error` if there is no such run, or the truth gives none of its keyframes a true place.
std::pair<place::RunEvaluation, nlohmann::ordered_json> evaluate_folder(const std::filesystem::path& folder,
                                                                        const TruthOptions& truth);

/// The contents of errors.csv of an evaluated run. Throws `vo::Error` if there is none.
place::TimedQueries read_errors(const std::filesystem::path& folder);

/// Tolerance and unit in metrics.json of an evaluated run. Throws `vo::Error` if there is none.
std::pair<double, std::string> read_tolerance(const std::filesystem::path& folder);

}  // namespace retrace
