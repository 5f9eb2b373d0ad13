#pragma once

#include "place/describe/column_stack.hpp"
#include "place/match/costs.hpp"

#include <cstddef>
#include <memory>

namespace place {

/// Settings of `ShiftedCosine`.
struct ShiftedCosineOptions {
  /// Columns by which a view may be shifted to either side, S below; fewer than a descriptor has.
  int max_shift_columns = 2;
};

/// Costs of descriptors of columns, for views that are turned a little. With C columns, and sums D of
/// products, Q of the query's squares and R of the reference's over the columns that overlap,
///
///   cost = min over s = -S .. S of 1 - sqrt((C - |s|) / C) * D / sqrt(Q R),
///          D = sum over j of query column j + s . reference column j
///
/// A cosine over few columns is more often large by chance; the square root corrects the spread. If one side
/// is all zeros, D counts as 0.
///
/// The number of each cost is defined exactly, so that it is the same for any instruction set, block and
/// number of threads: D, Q and R are whole numbers; f = 1 / sqrt(R) and g = sqrt((C - |s|) / (C Q)) are
/// computed in double and rounded to float; (float(D) * f) * g is rounded to float at each step; and 1 minus
/// that is rounded to the nearest multiple of `unit()`, 2^-15, ties to even.
///
/// Five shifts of eight columns take 24 products of columns instead of 34 if no value of either side exceeds
/// +-63: 0.7 times the time for the same numbers. (The same is done for any number of columns that gains from
/// it.)
class ShiftedCosine final : public CostSource {
 public:
  /// Both have the same columns and channels, and are kept by reference. Throws `std::invalid_argument` if
  /// they differ, if a value is -128, if the shift leaves no column, or for descriptors of more than 130,000
  /// bytes (sums would not fit 31 bits). Keeps a packed copy of the queries, of two to five times their size,
  /// and 4 * (2 S + 1) bytes for each reference.
  ShiftedCosine(const ColumnStack& queries, const ColumnStack& references,
                const ShiftedCosineOptions& options = {});
  ~ShiftedCosine() override;

  [[nodiscard]] std::size_t queries() const override;
  [[nodiscard]] std::size_t references() const override;
  [[nodiscard]] float unit() const override;
  /// O(queries * references * bytes * shifts).
  void compute(const Costs& block) const override;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace place
