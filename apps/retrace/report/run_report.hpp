#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <place/evaluation/run_evaluation.hpp>
#include <vo/base/trajectory.hpp>

namespace retrace {

/// The truth of a run, after evaluation.
struct RunTruth : place::RunEvaluation {
  place::GroundTruth truth;
  vo::Trajectory poses;  ///< the query's, if its truth has them
};

/// "metres" or "reference frames".
std::string name_of(place::ErrorUnit unit);

/// How precision and recall are counted, for people.
extern const std::string_view kCounting;

/// The report of a run, from the files in its folder: matches.csv and, if present, summary.json, config.toml,
/// `data` (see run_data.hpp) and the trajectories; with the truth after evaluation. Anything missing is left
/// out. Throws `vo::Error` if matches.csv cannot be read.
std::string run_report(const std::filesystem::path& folder, const nlohmann::ordered_json& data,
                       const RunTruth* truth = nullptr);

}  // namespace retrace
