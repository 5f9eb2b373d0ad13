#pragma once

#include "place/describe/descriptor.hpp"
#include "place/match/candidates.hpp"
#include "place/match/costs.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace place {

/// The costs of one kind of descriptors, comparable ones (`Descriptor::comparable`), in the way of their
/// form: pixels by absolute difference, columns by the shifted cosine, rows by the metric of the traits. Both
/// must outlive the source. `max_shift_px`: of a picture 64 wide, instead of the descriptor's own; passed
/// over by what cannot be shifted. Throws `std::invalid_argument` for descriptors of different forms or
/// sizes.
std::unique_ptr<CostSource> descriptor_costs(const Descriptors& queries, const Descriptors& references,
                                             const DescriptorTraits& traits,
                                             std::optional<int> max_shift_px = {});

/// `candidates` of descriptors of any form. Of columns the leading channels are looked at, which hold most of
/// what tells them apart; rows of floats are all candidates.
std::vector<std::size_t> candidates(const Descriptors& queries, const Descriptors& references,
                                    const CandidateOptions& options = {});

}  // namespace place
