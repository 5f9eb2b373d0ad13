#pragma once

#include "kernels/line_sums.hpp"

#include <limits>

/// The kernels, written once for any kind of lanes. Included only by the sources of `kernels`.
namespace place::kernels {

template <class Lanes>
void accumulate(const Accumulation& a) {
  std::size_t i = 0;
  for (; i + Lanes::kCount <= a.count; i += Lanes::kCount) {
    const auto from_centre = Lanes::sub(Lanes::load(a.costs + i), Lanes::all(a.centre));
    const auto whole = Lanes::to_nearest(Lanes::mul(from_centre, Lanes::all(a.scale)));
    Lanes::store(a.out + i, Lanes::add(Lanes::load(a.before + i), whole));
  }
  if (i == a.count) return;
  float costs[Lanes::kCount] = {};
  std::uint32_t before[Lanes::kCount] = {}, out[Lanes::kCount];
  for (std::size_t k = i; k < a.count; ++k) costs[k - i] = a.costs[k], before[k - i] = a.before[k];
  accumulate<Lanes>({costs, a.centre, a.scale, before, out, Lanes::kCount});
  for (std::size_t k = i; k < a.count; ++k) a.out[k] = out[k - i];
}

/// Calls `take(line, sums)` with each line's sums over a chunk.
template <class Lanes, class Take>
inline void for_each_line(const LineSums& lines, std::size_t column, const Take& take) {
  constexpr std::size_t kRegisters = kChunk / Lanes::kCount;
  const RunEnds* run = lines.runs;
  for (std::size_t line = 0; line < lines.lines; ++line) {
    typename Lanes::Int sums[kRegisters];
    const auto of_run = [&run, column](std::size_t k) {
      const std::size_t at = column + k * Lanes::kCount;
      return Lanes::sub(Lanes::load(run->last + at), Lanes::load(run->before + at));
    };
    const RunEnds* const end = run + lines.counts[line];
    for (std::size_t k = 0; k < kRegisters; ++k) sums[k] = of_run(k);
    for (++run; run != end; ++run) {
      for (std::size_t k = 0; k < kRegisters; ++k) sums[k] = Lanes::add(sums[k], of_run(k));
    }
    take(line, sums);
  }
}

template <class Lanes>
inline float store_costs(const typename Lanes::Float (&least)[kChunk / Lanes::kCount], float* costs) {
  typename Lanes::Float all = least[0];
  for (std::size_t k = 0; k < kChunk / Lanes::kCount; ++k) {
    Lanes::store(costs + k * Lanes::kCount, least[k]);
    all = Lanes::min(all, least[k]);
  }
  return Lanes::least(all);
}

template <class Lanes>
float least(const LineSums& lines, std::size_t column, float factor, float* costs) {
  constexpr std::size_t kRegisters = kChunk / Lanes::kCount;
  typename Lanes::Int sums[kRegisters];
  for (auto& sum : sums) sum = Lanes::all(std::uint32_t{std::numeric_limits<std::int32_t>::max()});
  for_each_line<Lanes>(lines, column, [&](std::size_t, const typename Lanes::Int(&of_line)[kRegisters]) {
    for (std::size_t k = 0; k < kRegisters; ++k) sums[k] = Lanes::min(sums[k], of_line[k]);
  });
  typename Lanes::Float least[kRegisters];
  for (std::size_t k = 0; k < kRegisters; ++k)
    least[k] = Lanes::mul(Lanes::to_float(sums[k]), Lanes::all(factor));
  return store_costs<Lanes>(least, costs);
}

template <class Lanes>
float least_weighted(const LineSums& lines, std::size_t column, const float* factors, const float* terms,
                     float* costs) {
  constexpr std::size_t kRegisters = kChunk / Lanes::kCount;
  typename Lanes::Float least[kRegisters];
  for (auto& cost : least) cost = Lanes::all(std::numeric_limits<float>::infinity());
  for_each_line<Lanes>(lines, column, [&](std::size_t line, const typename Lanes::Int(&sums)[kRegisters]) {
    for (std::size_t k = 0; k < kRegisters; ++k) {
      const std::size_t at = line * kChunk + k * Lanes::kCount;
      const auto product = Lanes::mul(Lanes::to_float(sums[k]), Lanes::load(factors + at));
      least[k] = Lanes::min(least[k], Lanes::add(product, Lanes::load(terms + at)));
    }
  });
  return store_costs<Lanes>(least, costs);
}

template <class Lanes>
inline constexpr LineKernels kLineTable{
    .accumulate = accumulate<Lanes>, .least = least<Lanes>, .least_weighted = least_weighted<Lanes>};

}  // namespace place::kernels
