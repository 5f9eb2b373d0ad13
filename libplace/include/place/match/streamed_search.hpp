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
  CostOptions cost;  ///< for images; other sources have their own
  ContrastEnhancementOptions enhancement;
  SequenceSearchOptions search;
  /// Bytes of costs kept between the two passes, 2 for each cost; the others are computed twice.
  std::size_t kept_bytes = std::size_t{4} << 30U;
};

/// Receives parts of a matrix: all queries by stretches of the reference, in order.
using PartCallback = std::function<void(const ConstCosts&)>;
struct MatrixCallbacks {
  PartCallback cost, enhanced;
};

/// Cost matrix -> contrast enhancement -> sequence search, a part of the reference at a time, so that the
/// whole matrix never exists. The matches equal those of the three stages in sequence, up to the rounding
/// that `SequenceSearcher` states, and do not depend on `kept_bytes`.
///
/// Enhancement needs all costs before its first result, so there are two passes: the first surveys, the
/// second enhances and searches. `source`: of costs, for any descriptors. `callbacks`: those that are set are
/// called with each part. Throws `std::invalid_argument` for options that are not valid. Memory besides the
/// descriptors: at most kept_bytes, a part of 16 MB or 512 references, and that of `SequenceSearcher`.
std::vector<SequenceMatch> search_streamed(const CostSource& source,
                                           const StreamedSearchOptions& options = {},
                                           const MatrixCallbacks& callbacks = {});

/// The same for patch-normalised images, see `cost_matrix`.
std::vector<SequenceMatch> search_streamed(const vo::ImageStack& queries, const vo::ImageStack& references,
                                           const StreamedSearchOptions& options = {},
                                           const MatrixCallbacks& callbacks = {});

}  // namespace place
