#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace place {

/// Computes the sums D(s), s = -S .. S, of products of query column j + s with reference column j over all j
/// where both exist, from a few dot products.
///
/// Directly, D(s) is one dot product over the overlap, a stretch of each descriptor: for eight columns and
/// five shifts 8 + 2 * 7 + 2 * 6 = 34 products of columns.
///
/// Five shifts take 24 products after identities of fast correlation (Winograd 1980; Blahut, *Fast Algorithms
/// for Signal Processing*, ch. 5), on integers and so exact. With e and o for even and odd columns and
/// EE(m) = sum over i of e_query(i + m) . e_reference(i), OO likewise:
///
///   D(2m) = EE(m) + OO(m)
///   D(1)  = X(0)  - OO(0)  - EE(1),  D(-1) = X(-1) - OO(-1) - EE(0),
///   X(m)  = sum over i of (o_query(i + m) + e_query(i + m + 1)) . (e_reference(i) + o_reference(i))
///
/// and EE(-1 .. 1) for two neighbours g0, g1 of the reference and four d0 .. d3 of the query takes four
/// products in place of six:
///
///   d0.g0 + d1.g1 = A + (B + C) / 2     A = (d0 - d2).g0    B = (d1 + d2).(g0 + g1)
///   d1.g0 + d2.g1 =     (B - C) / 2     C = (d2 - d1).(g0 - g1)
///   d2.g0 + d3.g1 =     (B + C) / 2 - D     D = (d1 - d3).g1
///
/// Both descriptors are spread once into the sums and differences to multiply, which must fit a byte, so the
/// descriptors' values are at most 63. The result is ten dot products: A, B, C and D of the even columns, of
/// the odd columns, X(-1) and X(0), in the order of `ShiftPlan::stretches`.
struct ShiftPlan {
  /// Columns [query, query + length) of the spread query times [reference, reference + length) of the spread
  /// reference.
  struct Stretch {
    std::size_t query, reference, length;
  };

  bool fast = false;
  std::size_t columns = 0;                               ///< of a descriptor
  std::size_t query_columns = 0, reference_columns = 0;  ///< after spreading
  std::vector<Stretch> stretches;
};

/// The largest magnitude of values that a fast plan can handle.
inline constexpr int kFastLimit = 63;

/// A stretch for each shift, s from -max_shift up. 0 <= max_shift < columns.
ShiftPlan direct_plan(std::size_t columns, std::size_t max_shift);

/// The plan for five shifts.
ShiftPlan fast_plan(std::size_t columns);

/// Spreads a descriptor, column after column of `channels` values, into a row with `row_channels` per column;
/// those past `channels` are 0.
void spread_query(const ShiftPlan& plan, std::span<const std::int8_t> descriptor, std::size_t row_channels,
                  std::span<std::int8_t> row);
void spread_reference(const ShiftPlan& plan, std::span<const std::int8_t> descriptor,
                      std::size_t row_channels, std::span<std::int8_t> row);

}  // namespace place
