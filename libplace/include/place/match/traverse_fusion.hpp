#pragma once

#include "place/certainty/sure_search.hpp"
#include "place/match/cost_matrix.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace place {

/// Where each keyframe of a traverse lies on another one: between two of its keyframes, as a fraction; none
/// where that is not known, or the other did not go.
using TraverseMap = std::vector<std::optional<double>>;

/// From the matches of a traverse's keyframes on another traverse (`search_surely`): those of a probability
/// of 0.95 that go on along the other, and between two of them, up to ten keyframes apart, the places
/// between.
TraverseMap map_from_matches(std::span<const SureMatch> matches);

/// The same from the other traverse, which has `count` keyframes, back.
TraverseMap inverse_map(const TraverseMap& map, std::size_t count);

/// A walk's costs against a further traverse, and where on it the keyframes of the first lie.
struct FurtherCosts {
  const CostMatrix* enhanced = nullptr;
  const TraverseMap* map = nullptr;
};

/// Joins what several traverses of a route say of one place, so that a walk by night finds it on the walk by
/// night and one in the rain on that in the rain, and where two are alike they bear each other out. `base`:
/// the walk's enhanced costs against one traverse; it becomes, for each of that traverse's places,
///
///   -log(mean over the traverses that have the place of exp(-cost)),
///
/// the cost under a mixture of conditions of which each is as probable, costs being log likelihoods (those of
/// `search_path` at twice its steepness: of several traverses one is to be believed, not an average); between
/// two keyframes of a further traverse the lower of both costs. Then each query's and each place's costs are
/// standardised again (`Enhancement::kStandardise`). Without a further traverse that has a place `base` stays
/// as it is. Throws `std::invalid_argument` for matrices or maps that do not belong together. O(queries *
/// references * traverses), in parallel.
void fuse_traverses(CostMatrix& base, std::span<const FurtherCosts> further);

}  // namespace place
