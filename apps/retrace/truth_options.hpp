#pragma once

#include "arguments.hpp"

#include <string>

#include <place/evaluation/run_evaluation.hpp>
#include <vo/base/trajectory.hpp>

namespace retrace {

/// The truth of a query, and the tolerance for a right match.
struct TruthOptions {
  std::string pairs;            ///< pairs.csv; or else
  std::string query_truth;      ///< truth.csv of the query,
  std::string reference_truth;  ///< and of the reference, which may also be given with `pairs`
  place::Tolerance tolerance;
};

void declare_truth(Arguments& arguments, TruthOptions& options);

/// The same where a list of pairs may be given instead, so that none is required.
void declare_optional_truth(Arguments& arguments, TruthOptions& options);

/// What is missing of a truth, or given twice, in words; empty if nothing is.
std::string what_truth_lacks(const TruthOptions& options);

/// The truth, and the query's true poses if it has them.
struct Truth {
  place::GroundTruth places;
  vo::Trajectory poses;
};

/// Reads the files. Throws `vo::Error` if they cannot be read or do not give errors in the tolerance's unit.
Truth read_truth(const TruthOptions& options);

/// The file that says where the query was, for messages.
const std::string& truth_file(const TruthOptions& options);

/// "4 metres", for people.
std::string tolerance_text(const place::Tolerance& tolerance);

}  // namespace retrace
