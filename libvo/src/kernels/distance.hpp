#pragma once

#include "kernels/kernels.hpp"

namespace vo::kernels {

/// |q|^2 + |r|^2 - 2 q.r, not below 0.
template <class Lanes>
void squared_distances(const DistanceBlock& block) {
  typename Lanes::Float dots[kLanes];
  for (auto& dot : dots) dot = Lanes::all(0.0F);
  for (std::size_t k = 0; k < block.size; ++k) {
    const auto reference = Lanes::load(block.references.values + k * kLanes);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const auto query = Lanes::all(block.queries.values[i * block.size + k]);
      dots[i] = Lanes::add(dots[i], Lanes::mul(query, reference));
    }
  }
  const auto zero = Lanes::all(0.0F), reach = Lanes::all(block.squared_reach_px);
  const auto norms = Lanes::load(block.references.norms);
  const auto x = Lanes::load(block.references.x_px), y = Lanes::load(block.references.y_px);
  auto minima = Lanes::load(block.minima);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const auto dx = Lanes::sub(x, Lanes::all(block.queries.x_px[i]));
    const auto dy = Lanes::sub(y, Lanes::all(block.queries.y_px[i]));
    const auto apart = Lanes::add(Lanes::mul(dx, dx), Lanes::mul(dy, dy));
    const auto sum = Lanes::add(Lanes::all(block.queries.norms[i]), norms);
    const auto difference = Lanes::max(Lanes::sub(sum, Lanes::add(dots[i], dots[i])), zero);
    const auto distance = Lanes::infinite_unless(Lanes::sub(reach, apart), difference);
    minima = Lanes::min(minima, distance);
    block.within[i] = Lanes::greater_equal(Lanes::all(block.limits[i]), distance);
    Lanes::store(block.out[i], distance);
  }
  Lanes::store(block.minima, minima);
}

}  // namespace vo::kernels
