#pragma once

#include "place/describe/float_rows.hpp"

#include <cstddef>

namespace place {

/// The rows of a matrix, or its columns, arranged so that they can be multiplied by many others.
///
/// A product of two rows is added up in the order of the values, in stretches of 1024 whose sums are added in
/// turn, each step rounded to float: the same bits for any instruction set and number of threads. Parallel
/// over the rows on the left.
class RowPanels {
 public:
  explicit RowPanels(const FloatRows& rows);

  /// The columns of `matrix` instead of its rows.
  static RowPanels of_columns(const FloatRows& matrix);

  /// Element [i][j] is the product of left[i] with row j. Throws `std::invalid_argument` for rows of another
  /// length.
  [[nodiscard]] FloatRows products(const FloatRows& left) const;

 private:
  RowPanels() = default;

  std::size_t count_ = 0, width_ = 0;
  FloatRows panels_;  ///< value by value, of as many rows as the kernel takes at a time; zeros fill the last
};

/// The products of all pairs of rows, or of all pairs of columns: a symmetric matrix, at half the cost.
FloatRows products_of_rows(const FloatRows& rows);
FloatRows products_of_columns(const FloatRows& matrix);

}  // namespace place
