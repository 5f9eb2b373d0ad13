#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// A match's probability, and whether it was right.
struct ProbableMatch {
  double probability = 0;
  bool right = false;
};

/// Matches of about equal probability.
struct ReliabilityBin {
  std::size_t matches = 0;
  double lowest = 0, highest = 0;  ///< probability
  double mean = 0;                 ///< probability: the share expected to be right
  double right = 0;                ///< share that were right
};

/// How well probabilities agree with the share of right matches.
struct Calibration {
  std::vector<ReliabilityBin> bins;  ///< by increasing probability, of equal counts to within one match
  double error = 0;  ///< expected calibration error: the mean of |mean - right|, weighted by matches
};

/// Reliability in bins of equal counts (the bins of Naeini, Cooper, Hauskrecht 2015). With fewer matches than
/// bins, each match is a bin; no matches give no bins and an error of 0. Matches of equal probability keep
/// their order. Throws `std::invalid_argument` for a probability outside 0 to 1 or bins < 1. O(n log n).
Calibration calibration(std::span<const ProbableMatch> matches, int bins = 10);

}  // namespace place
