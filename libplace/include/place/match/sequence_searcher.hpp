#pragma once

#include "place/match/sequence_search.hpp"
#include "place/match/team.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace place {

/// `search_sequences` over successive parts of the reference, each with all queries, so that the whole matrix
/// need never exist.
///
/// Costs are rounded to whole multiples of a power of two, the finest for which `length` times the largest
/// still fits 30 bits: 2^-20 for 2000 standardised queries and sequences of 20. All sums are then exact. A
/// line is made of runs of a constant step, and the sum of a run is the difference of two running sums along
/// that step, so a cell takes O(runs) for each line: about 1 + 2 |slope - m| * length runs for slopes near a
/// whole number m, and one for m itself at any length.
///
/// Memory: 4 bytes for each reference of a part, row of the sequence and step (0 .. 4) that the lines need, 4
/// for each reference of a part and row worked on together (64), and 4 for each query and keyframe of the
/// uniqueness window. Time O(queries * references * runs of all lines), in parallel over stretches of a part.
class SequenceSearcher {
 public:
  static constexpr std::size_t kPart = 32;  ///< a part has a multiple of this many references

  /// Throws `std::invalid_argument` for options that are not valid.
  SequenceSearcher(std::size_t queries, std::size_t references, const CostRange& range,
                   const SequenceSearchOptions& options = {});
  ~SequenceSearcher();
  SequenceSearcher(SequenceSearcher&&) noexcept;
  SequenceSearcher& operator=(SequenceSearcher&&) noexcept;

  /// The number of references that lines reach beyond a part on either side.
  [[nodiscard]] std::size_t margin() const;

  /// Takes the next `count` references, in order. `costs` has at least margin() more on either side, as far
  /// as the reference goes. Except in the last part, `count` is a multiple of kPart and at least the
  /// uniqueness window. Throws `std::invalid_argument` for other costs.
  void push(const ConstCosts& costs, std::size_t count);

  /// One match for each query. Throws `std::invalid_argument` if references are missing.
  std::vector<SequenceMatch> finish();

  /// What a member of a team finds on its shard, for one query.
  struct OnShard {
    SequenceMatch best;             ///< its score is that against the shard alone
    float elsewhere = 0;            ///< the least cost outside the best one's window
    std::vector<float> head, tail;  ///< costs of the first and of the last references, a window of each ...
    float after_head = 0;           ///< ... and the least cost of all but these
    float before_tail = 0;
  };
  /// Searches references [own.begin, own.end) alone, instead of `push` and `finish`; `costs` as for `push`.
  /// Infinite costs are of nothing.
  std::vector<OnShard> search_shard(const ConstCosts& costs, const Shard& own);

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace place
