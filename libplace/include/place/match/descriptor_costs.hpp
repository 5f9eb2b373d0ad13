#pragma once

#include "place/describe/descriptor.hpp"
#include "place/match/candidates.hpp"
#include "place/match/costs.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace place {

/// The costs of comparable descriptors of one kind (`Descriptor::comparable`), depending on their form:
/// pixels by absolute difference, columns by the shifted cosine, rows by the metric of the traits. Both must
/// outlive the source. `max_shift_px`: for a picture 64 wide, instead of the descriptor's own; ignored by
/// descriptors that cannot be shifted. Throws `std::invalid_argument` for descriptors of different forms or
/// sizes.
std::unique_ptr<CostSource> descriptor_costs(const Descriptors& queries, const Descriptors& references,
                                             const DescriptorTraits& traits,
                                             std::optional<int> max_shift_px = {});

/// `candidates` for descriptors of any form. For columns only the leading channels are used, which
/// distinguish them most; for rows of floats, all are candidates.
std::vector<std::size_t> candidates(const Descriptors& queries, const Descriptors& references,
                                    const CandidateOptions& options = {});

/// The pictures that `candidates` looks at for descriptors of this form; none for rows of floats. `options`:
/// as these pictures need them.
std::optional<vo::ImageStack> candidate_pictures(const Descriptors& descriptors, CandidateOptions& options);

}  // namespace place
