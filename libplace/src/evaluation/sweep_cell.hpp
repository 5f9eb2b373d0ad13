#pragma once

#include "place/evaluation/run_evaluation.hpp"
#include "place/evaluation/sweep_grid.hpp"
#include "place/match/cost_matrix.hpp"
#include "place/match/route_matching.hpp"
#include "place/route/route.hpp"
#include "place/route/walk_sampling.hpp"

#include <cstddef>
#include <optional>
#include <string>

#include <vo/odometry.hpp>

/// One cell of a sweep: two walks sampled, their costs, and the search through them.
namespace place {

struct WalkPair {
  vo::Walk query;
  vo::Walk reference;
};

/// Two walks reduced to keyframes, and their costs.
struct SampledPair {
  Route route;  ///< its only traverse is the reference
  SampledWalk query;
  CostMatrix cost;
  std::string density;  ///< the setting of the density and its value: "spacing-m=0.85"
};

/// Keyframes of both walks together.
std::size_t keyframes_of(const SampledPair& sampled);

/// Both walks on one route, up to the cost matrix. With `sequence-length-m`, the reference has the distances
/// of the truth. Throws `vo::Error` as `add` and `sample_walk` do.
SampledPair sample_pair(const WalkPair& walks, const Settings& given, const GroundTruth& truth);

/// The same with `sampling-n` and `spacing-m` multiplied until `keyframes_of` is within 1 % of `target`, or
/// as close as eight attempts come. Throws `vo::Error` if that is not within 5 %, and as `sample_pair` does.
/// With motion none nothing can be multiplied, and the density is as given.
SampledPair sample_equally(const WalkPair& walks, const Settings& given, const GroundTruth& truth,
                           std::size_t target);

/// Searches an enhanced matrix (`compat`: the keyframes' own thumbnails) and compares the matches with the
/// truth; none if the reference is shorter than the sequence.
std::optional<CellResult> run_cell(const SampledPair& sampled, const CostMatrix& enhanced,
                                   const RouteMatchingOptions& matching, const WalkPair& walks,
                                   const GroundTruth& truth, const Tolerance& tolerance);

}  // namespace place
