#pragma once

#include "kernels/dot_product.hpp"

/// The kernels, written once for any kind of lanes. Included only by the sources of `kernels`.
namespace place::kernels {

using vo::lanes::kLine;
using vo::lanes::unrolled;

inline constexpr std::size_t kAhead = 64;  ///< 32-bit groups to prefetch ahead

template <class Lanes>
[[gnu::always_inline]] inline auto load_sums(const std::int32_t* from) {
  return Lanes::load(reinterpret_cast<const std::uint32_t*>(from));
}

/// Holds kQueries * kRegisters sums in registers. Not inlined: in a larger function compilers run out of
/// registers and spill sums.
template <class Lanes, std::size_t kQueries, std::size_t kRegisters>
[[gnu::noinline]] void multiply_tile(const DotTile& tile) {
  constexpr std::size_t kBytes = Lanes::kCount * sizeof(std::uint32_t);
  typename Lanes::Int sums[kQueries][kRegisters];
  unrolled<kRegisters>([&](std::size_t j) __attribute__((always_inline)) {
    const auto start = load_sums<Lanes>(tile.start + j * Lanes::kCount);
    unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) { sums[i][j] = start; });
  });
  const std::uint8_t* query = tile.queries;
  const std::uint8_t* reference = tile.references;
  for (std::size_t k = 0; k < tile.size; k += Lanes::kPacking.group) {
    for (std::size_t line = 0; line < kRegisters * kBytes; line += kLine)
      __builtin_prefetch(reference + kAhead * kRegisters * kBytes + line, 0, 3);
    __builtin_prefetch(query + kAhead * kQueries * sizeof(std::uint32_t), 0, 3);
    typename Lanes::Products references[kRegisters];
    unrolled<kRegisters>([&](std::size_t j) __attribute__((always_inline)) {
      references[j] = Lanes::load_products(reference + j * kBytes);
    });
    unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) {
      const auto left = Lanes::all_products(query + i * sizeof(std::uint32_t));
      unrolled<kRegisters>([&](std::size_t j) __attribute__((always_inline)) {
        sums[i][j] = Lanes::add_products(sums[i][j], left, references[j]);
      });
    });
    query += kQueries * sizeof(std::uint32_t);
    reference += kRegisters * kBytes;
  }
  unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) {
    unrolled<kRegisters>([&](std::size_t j) __attribute__((always_inline)) {
      Lanes::store(reinterpret_cast<std::uint32_t*>(tile.sums) + (i * kRegisters + j) * Lanes::kCount,
                   sums[i][j]);
    });
  });
}

/// Calls `value(shift, lanes from)` for each shift and keeps the cost of the largest.
template <class Lanes, class Sum>
[[gnu::always_inline]] inline void store_cost(const ShiftCosts& a, std::size_t shifts, std::size_t from,
                                              std::size_t references, const Sum& sum) {
  const auto alike = [&](std::size_t shift) __attribute__((always_inline)) {
    const auto scaled =
        Lanes::mul(Lanes::to_float(sum(shift)), Lanes::load(a.reference_scales + shift * references + from));
    return Lanes::mul(scaled, Lanes::all(a.query_scales[shift]));
  };
  auto most = alike(0);
  for (std::size_t shift = 1; shift < shifts; ++shift) most = Lanes::max(most, alike(shift));
  const auto units = Lanes::all(kCostUnits);
  const auto whole = Lanes::to_float(Lanes::to_nearest(Lanes::sub(units, Lanes::mul(most, units))));
  Lanes::store(a.costs + from, Lanes::mul(whole, Lanes::all(1 / kCostUnits)));
}

template <class Lanes, std::size_t kRegisters>
void shift_costs(const ShiftCosts& a) {
  for (std::size_t from = 0; from < kRegisters * Lanes::kCount; from += Lanes::kCount) {
    store_cost<Lanes>(
        a, a.shifts, from, kRegisters * Lanes::kCount, [&](std::size_t shift) __attribute__((always_inline)) {
          return load_sums<Lanes>(a.sums + shift * a.stride + from);
        });
  }
}

template <class Lanes, std::size_t kRegisters>
void shift_costs_of_five(const ShiftCosts& a) {
  for (std::size_t from = 0; from < kRegisters * Lanes::kCount; from += Lanes::kCount) {
    const auto at = [&](std::size_t which) __attribute__((always_inline)) {
      return load_sums<Lanes>(a.sums + which * a.stride + from);
    };
    // Sums at the lags -1, 0 and 1 of the even columns, and of the odd ones.
    typename Lanes::Int even[3], odd[3];
    const auto lags = [&](typename Lanes::Int(&of)[3], std::size_t first) __attribute__((always_inline)) {
      const auto sum = at(first + 1), difference = at(first + 2);
      const auto middle = Lanes::half(Lanes::add(sum, difference));
      of[0] = Lanes::add(at(first), middle);
      of[1] = Lanes::half(Lanes::sub(sum, difference));
      of[2] = Lanes::sub(middle, at(first + 3));
    };
    lags(even, 0);
    lags(odd, 4);
    const typename Lanes::Int sums[5] = {
        Lanes::add(even[0], odd[0]), Lanes::sub(Lanes::sub(at(8), odd[0]), even[1]),
        Lanes::add(even[1], odd[1]), Lanes::sub(Lanes::sub(at(9), odd[1]), even[2]),
        Lanes::add(even[2], odd[2])};
    store_cost<Lanes>(
        a, 5, from, kRegisters * Lanes::kCount, [&](std::size_t shift) __attribute__((always_inline)) {
          return sums[shift];
        });
  }
}

template <class Lanes, std::size_t kQueries, std::size_t kRegisters>
inline constexpr DotKernels kDotTable{.queries = kQueries,
                                      .references = kRegisters* Lanes::kCount,
                                      .packing = Lanes::kPacking,
                                      .multiply = multiply_tile<Lanes, kQueries, kRegisters>,
                                      .costs = shift_costs<Lanes, kRegisters>,
                                      .costs_of_five = shift_costs_of_five<Lanes, kRegisters>};

}  // namespace place::kernels
