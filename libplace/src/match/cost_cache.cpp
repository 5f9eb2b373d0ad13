#include "match/cost_cache.hpp"

#include <algorithm>
#include <atomic>
#include <limits>

#include <vo/base/parallel.hpp>

namespace place {

CostCache::CostCache(const CostSource& source, std::size_t bytes)
    : source_(source),
      size_(std::min(bytes / sizeof(std::uint16_t), source.queries() * source.references())),
      memory_(vo::make_large_array<std::uint16_t>(size_)) {}

void CostCache::keep(const ConstCosts& part) {
  const std::size_t count = part.queries * part.references;
  if (count > size_ - used_) return;
  std::uint16_t* const kept_above = memory_.get() + used_;
  Part kept{part.first_reference, part.references, std::vector<std::uint32_t>(part.queries), kept_above};
  constexpr float kExact = 1 << 20;  // floats still represent every multiple of the unit up to this
  const float per_unit = 1 / source_.unit();
  const auto units = [&](float cost) { return static_cast<std::int32_t>(cost * per_unit + 0.5F); };
  std::atomic<bool> fits = true;
  vo::parallel_for(part.queries, [&](std::size_t q) {
    const std::span<const float> row = part.row(q);
    float least = row[0], most = row[0];
    for (const float cost : row) {
      least = cost < least ? cost : least;
      most = cost > most ? cost : most;
    }
    const std::int32_t base = units(std::min(least, kExact / per_unit));
    if (most * per_unit > kExact || units(most) - base > std::numeric_limits<std::uint16_t>::max()) {
      fits = false;
      return;
    }
    kept.least[q] = static_cast<std::uint32_t>(base);
    std::uint16_t* above = kept_above + q * part.references;
    for (std::size_t r = 0; r < row.size(); ++r) above[r] = static_cast<std::uint16_t>(units(row[r]) - base);
  });
  if (!fits) return;
  used_ += count;
  parts_.push_back(std::move(kept));
}

void CostCache::fetch(const Costs& block) const {
  const std::size_t past = block.first_reference + block.references;
  std::size_t next = block.first_reference;
  const float unit = source_.unit();
  const auto make_until = [&](std::size_t reference) {
    if (reference > next) source_.compute(block.columns(next, reference - next));
    next = std::max(next, reference);
  };
  for (const Part& part : parts_) {
    const std::size_t first = std::max(next, part.first), end = std::min(past, part.first + part.count);
    if (first >= end) continue;
    make_until(first);
    vo::parallel_for(block.queries, [&](std::size_t q) {
      const std::uint16_t* above = part.above + q * part.count + (first - part.first);
      const std::span<float> costs = block.columns(first, end - first).row(q);
      const auto least = static_cast<std::int32_t>(part.least[q]);
      for (std::size_t r = 0; r < costs.size(); ++r) costs[r] = static_cast<float>(least + above[r]) * unit;
    });
    next = end;
  }
  make_until(past);
}

}  // namespace place
