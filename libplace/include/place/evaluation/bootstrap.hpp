#pragma once

#include "place/evaluation/evaluation.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace place {

/// The queries of a run in order of time.
struct TimedQueries {
  std::vector<double> time_s;
  std::vector<ScoredQuery> queries;
};

/// Settings of `bootstrap`.
struct BootstrapOptions {
  int resamples = 2000;
  double segment_s = 10;     ///< of walk that are drawn together
  double confidence = 0.95;  ///< of the intervals
  std::uint64_t seed = 1;
};

/// Between two percentiles equally far from either end.
struct Interval {
  double low = 0;
  double high = 0;
};

/// The uncertainty of a run's figures. No interval if the walk is a single segment, as nothing can be drawn.
struct RunBootstrap {
  std::vector<double> max_f1_of;  ///< for each resample; NaN if it has no query with a true place
  std::optional<Interval> max_f1, auc_pr, recall_at_100_precision, recall_at_1;
};

/// Confidence intervals of several runs of one walk (the block bootstrap: Kuensch, "The jackknife and the
/// bootstrap for general stationary observations", 1989, with blocks that do not overlap).
///
/// Neighbouring keyframes see the same place and are right or wrong together, so they must not be drawn one
/// by one: the walk is cut into segments of equal time, as many segments as there are get drawn with
/// replacement, and the figures are computed from them. All runs get the same segments in each resample, so
/// that they can be compared in pairs. Segments off the route are drawn as well: what is accepted there is
/// wrong. A resample in which no query has a true place gives no figures.
///
/// Throws `std::invalid_argument` for options out of range, or another number of times than queries. The same
/// seed gives the same intervals, for any number of threads. O(runs * resamples * n log n), in parallel.
std::vector<RunBootstrap> bootstrap(std::span<const TimedQueries> runs, double tolerance,
                                    const BootstrapOptions& options = {});

/// The difference of one run's max-F1 from another's.
struct PairedDifference {
  std::optional<Interval> interval;  ///< of the difference
  double share_above = 0;            ///< share of resamples in which it is above 0; equal ones count half
};

/// Compares two runs of one `bootstrap`, resample by resample.
PairedDifference paired_difference(const RunBootstrap& run, const RunBootstrap& other,
                                   double confidence = 0.95);

}  // namespace place
