#pragma once

#include "place/cost_matrix.hpp"

namespace place {

/// How the rows of a cost matrix are made comparable before sequences are searched.
enum class Enhancement {
  kNone,         ///< costs as they are
  kLocal,        ///< SeqSLAM's: each cost against its neighbours along the reference
  kStandardise,  ///< each query over all references, then each reference over all queries, to mean 0 and
                 ///< deviation 1
};

/// Settings of `enhance_contrast`.
struct ContrastEnhancementOptions {
  Enhancement method = Enhancement::kStandardise;
  int window = 10;  ///< keyframes, `kLocal`: neighbours up to window / 2 on either side (SeqSLAM: R = 10)
};

/// Enhances the contrast of a cost matrix, in place. Values stay "lower is more alike", and are in standard
/// deviations (but for `kNone`). `kLocal` takes the sample deviation over the window cut at the ends of the
/// reference (Milford and Wyeth 2012, Eq. 3; OpenSeqSLAM). Where there is no deviation (one reference, equal
/// costs) the value is 0: neither alike nor unlike. Throws `std::invalid_argument` if window < 2. O(queries *
/// references), in parallel; sums in double in a fixed order.
void enhance_contrast(CostMatrix& costs, const ContrastEnhancementOptions& options = {});

}  // namespace place
