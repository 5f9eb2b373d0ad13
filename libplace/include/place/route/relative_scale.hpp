#pragma once

#include "place/match/contrast_enhancement.hpp"
#include "place/match/costs.hpp"

namespace place {

/// Settings of `relative_scale`.
struct RelativeScaleOptions {
  double largest =
      4;  ///< scales 1 / largest .. largest are tried; one walk is seldom four times as fast as another
  int steps = 97;   ///< scales tried, evenly spaced in their logarithm
  int length = 10;  ///< keyframes on a line
  /// Deviations of cost that a scale must gain for every squared unit of its logarithm: if the matrix shows
  /// little, similar speeds are assumed.
  double prior_weight = 0.1;
  /// Deviations of cost by which lines of the best scale must be cheaper than those of scale 1, in the mean
  /// over all queries. With less, the matrix shows no speed, and a wrong scale does more harm than none.
  double min_gain = 0.1;
};

/// A scale and its certainty.
struct RelativeScale {
  double scale = 1;  ///< the best if it gains enough, else 1
  double best = 1;   ///< the best
  double gain = 0;   ///< deviations of cost that lines of the best scale gain over those of scale 1
  double cost = 0;   ///< of the best scale's lines in deviations, the mean over all queries
};

/// The length of a query keyframe step in reference keyframe steps, found by matching alone.
///
/// Alignment error gives a walk's speed only relative to its own mean (SSS 3.2 learns in frames), so two
/// walks at different mean speeds, frame rates or light are sampled at different distances, and their path
/// through the cost matrix is straight but not at 45 degrees. Lines of a single slope are searched through
/// the whole standardised matrix; the right slope is the one whose best lines are cheapest on average.
///
/// `costs`: of all query keyframes with all, or only likely (`candidates`), reference keyframes. The scale is
/// 1 if either has fewer than 3 / 2 * length keyframes, which is too few, or if the best one gains less than
/// `min_gain`. Throws `std::invalid_argument` for
/// options that are not valid. O(queries * references * steps * length), in parallel over queries.
RelativeScale relative_scale(CostMatrix costs, const RelativeScaleOptions& options = {},
                             const ContrastEnhancementOptions& enhancement = {});

}  // namespace place
