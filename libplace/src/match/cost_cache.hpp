#pragma once

#include "place/match/costs.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vo/base/large_memory.hpp>

namespace place {

/// Costs that are needed twice: as many as there is room for are kept, the others are computed again.
///
/// Costs are whole multiples of a unit, so a row's excess over its least cost in a part fits 16 bits: at most
/// two deviations per pixel for images of mean 0 and deviation 1, 65,536 units for 2048 pixels. Exact; a part
/// that does not fit (possible with larger images) is not kept.
class CostCache {
 public:
  /// Keeps `bytes` at most. `source` is kept by reference.
  CostCache(const CostSource& source, std::size_t bytes);

  /// Keeps a part from `source`, with all queries and references not kept yet. In parallel.
  void keep(const ConstCosts& part);

  /// Writes the costs of all queries and any references, kept or not. In parallel.
  void fetch(const Costs& block) const;

 private:
  struct Part {
    std::size_t first, count;
    std::vector<std::uint32_t> least;  ///< of each row, in units
    const std::uint16_t* above;        ///< over the row's least, row by row; in `memory_`
  };

  const CostSource& source_;
  std::size_t size_, used_ = 0;  ///< of `memory_`, costs
  vo::LargeArray<std::uint16_t> memory_;
  std::vector<Part> parts_;  ///< by increasing reference
};

}  // namespace place
