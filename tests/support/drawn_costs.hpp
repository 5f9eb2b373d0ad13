#pragma once

#include <cmath>
#include <cstdint>

#include <place/match/cost_matrix.hpp>
#include <place/match/sequence_search.hpp>
#include <vo/base/rng.hpp>

namespace test_support {

/// Enhanced costs of two walks of which nothing matches: independent multiples of 1/64 in [-2, 2], so that
/// sums of them are exact in any order.
inline place::CostMatrix chance_costs(std::size_t queries, std::size_t references, std::uint64_t seed) {
  vo::Rng rng(seed);
  place::CostMatrix costs = place::make_cost_matrix(queries, references);
  for (float& cost : costs.values) cost = static_cast<float>(static_cast<double>(rng.index(257)) - 128) / 64;
  return costs;
}

/// The same, but `depth` lower at the true place: the reference `first` + `speed` * q of query q, where there
/// is one.
inline place::CostMatrix walked_costs(std::size_t queries, std::size_t references, double first, double speed,
                                      float depth, std::uint64_t seed) {
  place::CostMatrix costs = chance_costs(queries, references, seed);
  for (std::size_t q = 0; q < queries; ++q) {
    const long r = std::lround(first + speed * static_cast<double>(q));
    if (r >= 0 && r < static_cast<long>(references)) costs.row(q)[static_cast<std::size_t>(r)] -= depth;
  }
  return costs;
}

inline bool same(const place::SequenceMatch& a, const place::SequenceMatch& b) {
  return a.reference == b.reference && a.slope == b.slope && a.cost == b.cost && a.score == b.score &&
         a.terms == b.terms;
}

}  // namespace test_support
