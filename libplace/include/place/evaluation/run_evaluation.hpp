#pragma once

#include "place/evaluation/calibration.hpp"
#include "place/evaluation/evaluation.hpp"
#include "place/evaluation/ground_truth.hpp"
#include "place/match/match.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace place {

/// The largest error that counts as right: one of the two.
struct Tolerance {
  std::optional<double> tolerance_m;       ///< metres along the route [SSS 4.2: 4]
  std::optional<double> tolerance_frames;  ///< reference frames
};

/// A run compared with the truth.
struct RunEvaluation {
  double tolerance = 0;  ///< in the unit
  ErrorUnit unit = ErrorUnit::kMetres;
  std::vector<PlaceError> errors;    ///< one for each match
  std::vector<ScoredQuery> queries;  ///< the same with scores
  Evaluation evaluation;
  OperatingPoint accepted;  ///< the run's own acceptance
  /// Of the matches' probabilities, where right means within tolerance of a true place. None without
  /// probabilities.
  std::optional<Calibration> calibration;
};

/// The distances of a reference's frames from its `truth.csv`; unknown ones lie between known ones
/// (`vo::distances_between`). Throws `vo::Error` as `vo::read_truth` does, and if none is known.
std::vector<double> distances_on(const std::filesystem::path& reference_truth);

/// The truth for a query and a reference that were both surveyed: `read_truth` of both. Throws `vo::Error` as
/// that does.
GroundTruth truth(const std::filesystem::path& query_truth, const std::filesystem::path& reference_truth);

/// Compares matches with the truth (SSS 4.2; counting as in `Evaluation`). Throws `vo::Error` if a frame is
/// outside the truth, `std::invalid_argument` unless one tolerance is given, in a unit that the truth
/// supports. O(matches log matches + matches * frames).
RunEvaluation evaluate(std::span<const Match> matches, const GroundTruth& truth, const Tolerance& tolerance);

}  // namespace place
