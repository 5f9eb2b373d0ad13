#pragma once

#include "kernels/float_sums.hpp"
#include "lanes/lanes.hpp"

/// The kernels, written once for any kind of lanes. Included only by the sources of `kernels`.
namespace place::kernels {

/// Holds kQueries * kRegisters sums in registers. Not inlined: in a larger function compilers run out of
/// registers and spill sums.
template <class Lanes, Term kTerm, std::size_t kQueries, std::size_t kRegisters>
[[gnu::noinline]] void add_tile(const FloatTile& tile) {
  using vo::lanes::unrolled;
  typename Lanes::Float sums[kQueries][kRegisters];
  unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) {
    unrolled<kRegisters>([&](std::size_t j)
                             __attribute__((always_inline)) { sums[i][j] = Lanes::all(0.0F); });
  });
  const float* query = tile.queries;
  const float* reference = tile.references;
  for (std::size_t k = 0; k < tile.size; ++k) {
    typename Lanes::Float references[kRegisters];
    unrolled<kRegisters>([&](std::size_t j) __attribute__((always_inline)) {
      references[j] = Lanes::load(reference + j * Lanes::kCount);
    });
    unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) {
      const auto value = Lanes::all(query[i]);
      unrolled<kRegisters>([&](std::size_t j) __attribute__((always_inline)) {
        if constexpr (kTerm == Term::kProduct) {
          sums[i][j] = Lanes::add(sums[i][j], Lanes::mul(value, references[j]));
        } else {
          const auto difference = Lanes::sub(value, references[j]);
          const auto term =
              kTerm == Term::kSquaredDifference ? Lanes::mul(difference, difference) : Lanes::abs(difference);
          sums[i][j] = Lanes::add(sums[i][j], term);
        }
      });
    });
    query += kQueries;
    reference += kRegisters * Lanes::kCount;
  }
  unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) {
    unrolled<kRegisters>([&](std::size_t j) __attribute__((always_inline)) {
      Lanes::store(tile.sums + (i * kRegisters + j) * Lanes::kCount, sums[i][j]);
    });
  });
}

template <class Lanes, std::size_t kQueries, std::size_t kRegisters>
void add_terms(Term term, const FloatTile& tile) {
  switch (term) {
    case Term::kProduct:
      return add_tile<Lanes, Term::kProduct, kQueries, kRegisters>(tile);
    case Term::kAbsoluteDifference:
      return add_tile<Lanes, Term::kAbsoluteDifference, kQueries, kRegisters>(tile);
    case Term::kSquaredDifference:
      break;
  }
  add_tile<Lanes, Term::kSquaredDifference, kQueries, kRegisters>(tile);
}

template <class Lanes, std::size_t kRegisters>
void float_costs(const FloatCostRow& a) {
  const auto units = Lanes::all(a.units), unit = Lanes::all(1 / a.units);
  for (std::size_t j = 0; j < kRegisters * Lanes::kCount; j += Lanes::kCount) {
    auto in_units = Lanes::load(a.sums + j);
    if (a.reference_scales != nullptr) {
      const auto cosine =
          Lanes::mul(Lanes::mul(in_units, Lanes::load(a.reference_scales + j)), Lanes::all(a.query_scale));
      in_units = Lanes::max(Lanes::sub(units, Lanes::mul(cosine, units)), Lanes::all(0.0F));
    } else {
      if (a.root) in_units = Lanes::sqrt(in_units);
      in_units = Lanes::mul(Lanes::mul(in_units, Lanes::all(a.query_scale)), units);
    }
    Lanes::store(a.costs + j, Lanes::mul(Lanes::to_float(Lanes::to_nearest(in_units)), unit));
  }
}

template <class Lanes, std::size_t kQueries, std::size_t kRegisters>
inline constexpr FloatKernels kFloatTable{.queries = kQueries,
                                          .references = kRegisters* Lanes::kCount,
                                          .add = add_terms<Lanes, kQueries, kRegisters>,
                                          .costs = float_costs<Lanes, kRegisters>};

}  // namespace place::kernels
