#pragma once

#include "place/contrast_enhancement.hpp"
#include "place/cost_matrix.hpp"
#include "place/sequence_search.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <vo/image/image_stack.hpp>

namespace place {

/// Settings of `search_streamed`.
struct StreamedSearchOptions {
  CostOptions cost;
  ContrastEnhancementOptions enhancement;
  SequenceSearchOptions search;
  /// Bytes of costs kept between the two passes; those of further rows are worked out twice.
  std::size_t kept_bytes = std::size_t{4} << 30U;
};

/// Whole rows of the matrices, the first of them that of query `first`, as they pass by.
struct MatrixRows {
  std::size_t first;
  std::span<const float> cost, enhanced;
};
using RowsCallback = std::function<void(const MatrixRows&)>;

/// Cost matrix -> contrast enhancement -> sequence search, a block of rows at a time, so that the matrix is
/// never there as a whole. The matches are those of the three stages one after the other, up to the rounding
/// that `SequenceSearcher` states, and do not depend on `kept_bytes`.
///
/// Enhancement needs all costs before it can give the first, so there are two passes: one surveys, the second
/// enhances and searches. `queries`, `references`: descriptors of one size. `rows`, if there, is called with
/// each block in order. Throws `std::invalid_argument` for options that are not valid. Memory beside the
/// descriptors: kept_bytes at most, and some 200 rows of references and what `SequenceSearcher` keeps.
std::vector<SequenceMatch> search_streamed(const vo::ImageStack& queries, const vo::ImageStack& references,
                                           const StreamedSearchOptions& options = {},
                                           const RowsCallback& rows = {});

}  // namespace place
