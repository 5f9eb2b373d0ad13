#pragma once

#include "report/run_report.hpp"

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace retrace {

/// What says where a query truly was, and how far off is still right.
struct TruthOptions {
  std::string pairs;                  ///< pairs.csv; or else
  std::string query_truth;            ///< truth.csv of the query,
  std::string reference_truth;        ///< and of the reference, which may also stand beside `pairs`
  std::optional<double> tolerance_m;  ///< this or the other
  std::optional<double> tolerance_frames;
};

void add_truth_options(CLI::App& app, TruthOptions& options);

/// Reads the files: truth, poses, tolerance and unit are filled in. Throws `vo::Error` if they cannot be read
/// or do not tell errors in the tolerance's unit.
RunTruth read_truth(const TruthOptions& options);

/// The file that says where the query was, for messages.
const std::string& truth_file(const TruthOptions& options);

/// Holds the place found for a query frame, none if it was not matched, against the truth; its error is added
/// to `run.errors`.
place::ScoredQuery judge(RunTruth& run, std::int64_t query_frame, std::optional<std::int64_t> reference_frame,
                         double score);

}  // namespace retrace
