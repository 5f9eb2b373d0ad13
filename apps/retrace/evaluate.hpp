#pragma once

#include "truth_options.hpp"

#include <string>

#include <nlohmann/json.hpp>

#include <place/evaluation/evaluation.hpp>

namespace retrace {

/// A run and the truth to hold it against.
struct EvaluationInputs {
  std::string folder;  ///< written by `retrace localise`
  TruthOptions truth;
};

/// A run held against the truth, as written to its folder.
struct EvaluatedRun {
  place::Evaluation evaluation;
  place::OperatingPoint accepted;  ///< the run's own acceptance
  std::string unit;                ///< of tolerance and errors, for people
  nlohmann::ordered_json metrics;  ///< what is in metrics.json
};

/// Evaluates a run and writes metrics.json, pr.csv and report.html into its folder. Throws `vo::Error` if
/// there is no such run, or the truth gives none of its keyframes a true place.
EvaluatedRun evaluate_run(const EvaluationInputs& inputs);

}  // namespace retrace
