#pragma once

#include "kernels/kernels.hpp"

namespace vo::kernels {

/// |q|^2 + |r|^2 - 2 q.r, not below 0.
template <class Lanes>
void squared_distances(const DistanceBlock& block) {
  typename Lanes::Float dots[4] = {Lanes::all(0.0F), Lanes::all(0.0F), Lanes::all(0.0F), Lanes::all(0.0F)};
  for (std::size_t k = 0; k < block.size; ++k) {
    const auto reference = Lanes::load(block.packed + k * Lanes::kCount);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto query = Lanes::all(block.query[i * block.size + k]);
      dots[i] = Lanes::add(dots[i], Lanes::mul(query, reference));
    }
  }
  const auto norms = Lanes::load(block.reference_norms);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto sum = Lanes::add(Lanes::all(block.query_norms[i]), norms);
    const auto distance = Lanes::sub(sum, Lanes::add(dots[i], dots[i]));
    Lanes::store(block.out[i], Lanes::max(distance, Lanes::all(0.0F)));
  }
}

}  // namespace vo::kernels
