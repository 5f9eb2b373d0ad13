#pragma once

#include "place/sequence_search.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace place {

/// `search_sequences` over rows that come one after another, so that a matrix need never be whole.
///
/// Costs are rounded to whole multiples of a power of two, the finest at which `length` of the largest still
/// fit 30 bits: 2^-20 for 2000 queries standardised and sequences of 20. From there on sums are exact. A line
/// is made of runs of a constant step, and the sum of a run is the difference of two running sums along that
/// step, so a cell takes O(runs) of each line: for slopes near a whole number m about 1 + 2 |slope - m| *
/// length, whatever the length for m itself.
///
/// Memory: 4 bytes for each reference, row of the sequence and step (0 .. 4) that the lines need, and 4 for
/// each reference and row worked on together (64). Time O(queries * references * runs of all lines), in
/// parallel over stretches of the reference.
class SequenceSearcher {
 public:
  /// Throws `std::invalid_argument` for options that are not valid.
  SequenceSearcher(std::size_t queries, std::size_t references, const CostRange& range,
                   const SequenceSearchOptions& options = {});
  ~SequenceSearcher();
  SequenceSearcher(SequenceSearcher&&) noexcept;
  SequenceSearcher& operator=(SequenceSearcher&&) noexcept;

  /// The next rows: any number of whole ones. Throws `std::invalid_argument` if they are not whole or too
  /// many.
  void push(std::span<const float> rows);

  /// One match for each query. Throws `std::invalid_argument` if rows are missing.
  std::vector<SequenceMatch> finish();

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace place
