#pragma once

#include <optional>
#include <span>
#include <vector>

namespace place {

/// One query keyframe for evaluation.
struct ScoredQuery {
  std::optional<double> score;  ///< of its match, higher is surer; none if the query is unmatched
  bool has_truth = false;       ///< whether it has a true place on the reference
  std::optional<double> error;  ///< distance of the match from the true place; none without match or truth
};

/// Counts and rates when every match with score >= threshold is accepted.
struct OperatingPoint {
  double threshold = 0;
  std::size_t true_positives = 0;   ///< accepted, within tolerance of the true place
  std::size_t false_positives = 0;  ///< accepted and not, also where the query has no true place
  std::size_t false_negatives = 0;  ///< with a true place but no true positive: refused, unmatched or wrong
  double precision = 0;             ///< true positives / accepted; 1 where nothing is accepted
  double recall = 0;                ///< TP / (TP + FN): of the queries with a true place
  double f1 = 0;                    ///< harmonic mean of both
};

/// Distribution of the errors of all matches with truth, accepted or not, in the unit of the tolerance.
struct ErrorPercentiles {
  double p50 = 0, p75 = 0, p90 = 0, p95 = 0, p99 = 0, max = 0;
};

/// Precision and recall of a run.
struct Evaluation {
  std::size_t queries = 0;
  std::size_t with_truth = 0;
  std::size_t matched = 0;
  std::size_t matched_without_truth = 0;
  std::vector<OperatingPoint>
      curve;            ///< one for every distinct score, from the highest threshold to the lowest
  OperatingPoint best;  ///< the highest F1; among equals, the highest threshold; without a match, that of
                        ///< accepting nothing
  double auc_pr = 0;    ///< average precision: sum of precision * increase of recall along the curve
  double recall_at_100_precision = 0;
  double recall_at_1 = 0;  ///< share of the queries with truth whose match, at any score, is within tolerance
  std::optional<ErrorPercentiles> errors;  ///< none if no match has truth
};

/// Evaluates a run (SSS 4.2; SeqSLAM's sweep of the uniqueness score). Every query with truth counts in
/// recall's denominator, matched or not. `tolerance` >= 0: a match is right if its error is at most that.
/// Throws `std::invalid_argument` for a negative tolerance or a score that is not a number. O(n log n).
Evaluation evaluate(std::span<const ScoredQuery> queries, double tolerance);

/// The operating point at one threshold.
OperatingPoint operating_point(std::span<const ScoredQuery> queries, double tolerance, double threshold);

}  // namespace place
