#pragma once

#include "place/certainty/sure_search.hpp"
#include "place/match/cost_matrix.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace place {

/// The place of each keyframe of a traverse on another one, as a fractional keyframe index; none where that
/// is not known, or the other did not go there.
using TraverseMap = std::vector<std::optional<double>>;

/// From the matches of a traverse's keyframes on another traverse (`search_surely`): those with a probability
/// of 0.95 that move forward along the other, and interpolated places between two of them up to ten keyframes
/// apart.
TraverseMap map_from_matches(std::span<const SureMatch> matches);

/// The inverse map, from the other traverse, which has `count` keyframes.
TraverseMap inverse_map(const TraverseMap& map, std::size_t count);

/// A walk's costs against a further traverse, and the places on it of the first one's keyframes.
struct FurtherCosts {
  const CostMatrix* enhanced = nullptr;
  const TraverseMap* map = nullptr;
};

/// Joins the costs of several traverses for each place, so that a walk by night finds it on the night
/// traverse and one in the rain on the rain traverse, and similar traverses reinforce each other. `base`: the
/// walk's enhanced costs against one traverse; it becomes, for each of that traverse's places,
///
///   -log(mean over the traverses that have the place of exp(-cost)),
///
/// the cost under a mixture of equally probable conditions, with costs as log likelihoods (those of
/// `search_path` at twice its steepness, so that the best traverse counts rather than an average). Between
/// two keyframes of a further traverse, the lower of both costs is used. Then each query's and each place's
/// costs are standardised again (`Enhancement::kStandardise`). `base` is unchanged if no further traverse has
/// a place. Throws `std::invalid_argument` for matrices or maps that do not belong together. O(queries *
/// references * traverses), in parallel.
void fuse_traverses(CostMatrix& base, std::span<const FurtherCosts> further);

}  // namespace place
