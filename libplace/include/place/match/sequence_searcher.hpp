#pragma once

#include "place/match/sequence_search.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace place {

/// `search_sequences` over parts of the reference that come one after another, each with all queries, so that
/// a matrix need never be whole.
///
/// Costs are rounded to whole multiples of a power of two, the finest at which `length` of the largest still
/// fit 30 bits: 2^-20 for 2000 queries standardised and sequences of 20. From there on sums are exact. A line
/// is made of runs of a constant step, and the sum of a run is the difference of two running sums along that
/// step, so a cell takes O(runs) of each line: for slopes near a whole number m about 1 + 2 |slope - m| *
/// length, whatever the length for m itself.
///
/// Memory: 4 bytes for each reference of a part, row of the sequence and step (0 .. 4) that the lines need, 4
/// for each reference of a part and row worked on together (64), and 4 for each query and keyframe of the
/// uniqueness window. Time O(queries * references * runs of all lines), in parallel over stretches of a part.
class SequenceSearcher {
 public:
  static constexpr std::size_t kPart = 32;  ///< a part has a multiple of so many references

  /// Throws `std::invalid_argument` for options that are not valid.
  SequenceSearcher(std::size_t queries, std::size_t references, const CostRange& range,
                   const SequenceSearchOptions& options = {});
  ~SequenceSearcher();
  SequenceSearcher(SequenceSearcher&&) noexcept;
  SequenceSearcher& operator=(SequenceSearcher&&) noexcept;

  /// References on either side of a part that its lines reach.
  [[nodiscard]] std::size_t margin() const;

  /// The next `count` references, in order. `costs` has margin() more on either side as far as the reference
  /// goes; more does no harm. But for the last part, `count` is a multiple of kPart and no less than the
  /// uniqueness window. Throws `std::invalid_argument` for costs that are not those.
  void push(const ConstCosts& costs, std::size_t count);

  /// One match for each query. Throws `std::invalid_argument` if references are missing.
  std::vector<SequenceMatch> finish();

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace place
