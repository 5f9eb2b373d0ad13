#pragma once

#include "place/match/contrast_enhancement.hpp"
#include "place/match/cost_matrix.hpp"
#include "place/match/sequence_search.hpp"

#include <cstddef>
#include <functional>
#include <vector>

#include <vo/image/image_stack.hpp>

namespace place {

/// Settings of `search_streamed`.
struct StreamedSearchOptions {
  CostOptions cost;  ///< of images; other sources have their own
  ContrastEnhancementOptions enhancement;
  SequenceSearchOptions search;
  /// Bytes of costs kept between the two passes, 2 for each; the others are worked out twice.
  std::size_t kept_bytes = std::size_t{4} << 30U;
};

/// Sees parts of a matrix pass by: all queries by stretches of the reference, in order.
using PartCallback = std::function<void(const ConstCosts&)>;
struct MatrixCallbacks {
  PartCallback cost, enhanced;
};

/// Cost matrix -> contrast enhancement -> sequence search, a part of the reference at a time, so that the
/// matrix is never there as a whole. The matches are those of the three stages one after the other, up to the
/// rounding that `SequenceSearcher` states, and do not depend on `kept_bytes`.
///
/// Enhancement needs all costs before it can give the first, so there are two passes: one surveys, the second
/// enhances and searches. `source`: of the costs, whatever the descriptors. `callbacks`: those that are there
/// are called with each part. Throws `std::invalid_argument` for options that are not valid. Memory beside
/// the descriptors: kept_bytes at most, a part of 16 MB or 512 references, and what `SequenceSearcher` keeps.
std::vector<SequenceMatch> search_streamed(const CostSource& source,
                                           const StreamedSearchOptions& options = {},
                                           const MatrixCallbacks& callbacks = {});

/// The same of patch-normalised images, see `cost_matrix`.
std::vector<SequenceMatch> search_streamed(const vo::ImageStack& queries, const vo::ImageStack& references,
                                           const StreamedSearchOptions& options = {},
                                           const MatrixCallbacks& callbacks = {});

}  // namespace place
