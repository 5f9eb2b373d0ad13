#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/route_matching.hpp"

#include <cstddef>
#include <memory>
#include <vector>

/// A walk's costs against a traverse of a route, from their descriptors.
namespace place {

/// 0, 1, ... count - 1
std::vector<std::size_t> counted(std::size_t count);

/// Keyframes of a sequence on a traverse. Throws `vo::Error` if metres are asked for and it has none.
int sequence_length_on(const Traverse& traverse, const RouteMatchingOptions& options);

/// Two walks to compare: with all of a traverse, or with a shortlist.
struct ComparedWalks {
  std::unique_ptr<CostSource> costs;          ///< of one descriptor, or the sum over several
  std::vector<std::size_t> columns;           ///< the traverse's keyframes compared with
  std::vector<Descriptors> query, reference;  ///< kept for `costs`
};
ComparedWalks compared_walks(const SampledWalk& sampled, const Traverse& traverse,
                             const RouteMatchingOptions& options, int length);

/// The walk's enhanced costs against the part of a traverse that it is compared with.
struct TraverseCosts {
  std::vector<std::size_t> columns;  ///< the keyframe of each reference
  CostMatrix enhanced;
};

/// `index`: of the traverse, for the callback. Costs that are not enhanced are standardised as a whole after
/// the callback has seen them, as likelihoods need deviations.
TraverseCosts costs_against(const SampledWalk& sampled, const Traverse& traverse, std::size_t index,
                            const RouteMatchingOptions& options, int length, const SearchCallback& callback);

/// The same of costs that are there: enhances them.
void enhance_compared(TraverseCosts& costs, std::size_t index, const RouteMatchingOptions& options,
                      const SearchCallback& callback);

/// Converts costs that were not enhanced to deviations from their mean, the unit of likelihoods.
void standardise_as_a_whole(CostMatrix& costs);

/// Whether a walk is compared with a shortlist of a traverse.
bool uses_shortlist(const RouteMatchingOptions& options, std::size_t queries, std::size_t references);

/// The gaps of a traverse, `gaps` by keyframe, as gaps of the compared columns; there are also gaps between
/// the stretches of a shortlist, where the traverse continues elsewhere.
std::vector<std::size_t> gaps_between(const std::vector<std::size_t>& columns,
                                      const std::vector<std::size_t>& gaps);

}  // namespace place
