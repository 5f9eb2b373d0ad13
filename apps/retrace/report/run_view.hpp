#pragma once

#include "report/run_report.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <place/match/match.hpp>

namespace retrace {

/// One walk of a run: the query, with a time and a displacement for every frame, or a traverse of the route,
/// with values for each of its keyframes. NaN where there is no value.
struct WalkColumns {
  std::string name;
  std::vector<double> frame;  ///< of the keyframes
  std::vector<double> time_s;
  std::vector<double> displacement;  ///< travelled so far
  std::vector<double> distance_m, x_m, y_m;
};

/// The counts in summary.json.
struct RunCounts {
  std::size_t queries = 0, query_frames = 0, matched = 0, accepted = 0;
  // What only a search of sequences has: `retrace follow` does not.
  std::optional<std::size_t> partial, partial_accepted, sequence_length;
  std::optional<double> accept_score, accept_probability, relative_scale;
  std::string query, route;
  std::vector<std::string> warnings;
};

/// The data for the figures of a run's report.
struct RunView {
  std::filesystem::path folder;
  std::vector<place::Match> matches;
  double unit = 0;  ///< displacement between keyframes; 0 if not known
  std::optional<WalkColumns> query;
  std::vector<WalkColumns> traverses;
  std::optional<RunCounts> counts;
  const nlohmann::ordered_json& data;  ///< see run_data.hpp; may be empty
  const RunTruth* truth;               ///< null before the run is evaluated
  /// The reference frame at which each query truly is, none where it is not known; empty before the run is
  /// evaluated.
  std::vector<std::optional<double>> true_frame;
};

/// Throws `vo::Error` if matches.csv cannot be read; anything else that is missing is left out.
RunView read_run(const std::filesystem::path& folder, const nlohmann::ordered_json& data,
                 const RunTruth* truth);

/// The true places of an evaluated run as `evaluate` wrote them, for a run that was read without its truth;
/// none from a run that an older version evaluated. Throws `vo::Error` if the file cannot be read.
std::vector<std::optional<double>> read_true_frames(const std::filesystem::path& folder);

/// The true place of a query frame on the reference, as a frame of it.
std::optional<double> true_frame(const place::GroundTruth& truth, std::int64_t query_frame);

/// 0, 1, ... count - 1.
std::vector<double> upto(std::size_t count);

/// y at `at`: linear between the points of increasing x, the value of the nearer end outside them. At least
/// one point.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at);

}  // namespace retrace
