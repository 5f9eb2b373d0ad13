#include "place/match/summed_costs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr float kUnit = 1.0F / 1024;
constexpr float kLowest = 31;  // deviations below the mean, over all parts together, that still count

}  // namespace

SummedCosts::SummedCosts(std::vector<SummedPart> parts) : parts_(std::move(parts)) {
  if (parts_.empty()) throw std::invalid_argument("SummedCosts: at least one part expected");
  Alone alone;
  survey(references(), {0, references()}, 0, alone);
}

SummedCosts::SummedCosts(std::vector<SummedPart> parts, std::size_t total, const Shard& own,
                         std::size_t first, Team& team)
    : parts_(std::move(parts)) {
  if (parts_.empty()) throw std::invalid_argument("SummedCosts: at least one part expected");
  survey(total, own, first, team);
}

void SummedCosts::survey(std::size_t total, const Shard& own, std::size_t first, Team& team) {
  for (const SummedPart& part : parts_) {
    if (part.costs->queries() != queries() || part.costs->references() != references())
      throw std::invalid_argument("SummedCosts: parts of one size expected");
    ContrastEnhancer& enhancer = enhancers_.emplace_back(
        queries(), total,
        ContrastEnhancementOptions{.method = Enhancement::kStandardise, .prior_queries = part.prior_queries},
        own, first);
    CostMatrix stretch;
    constexpr std::size_t kTogether = 8 * ContrastEnhancer::kPart;
    for (std::size_t at = own.begin - first; at < own.end - first; at += kTogether) {
      const std::size_t count = std::min(kTogether, own.end - first - at);
      stretch.values.resize(queries() * count);
      const Costs block{0, queries(), at, count, stretch.values.data(), count};
      part.costs->compute(block);
      enhancer.survey(block, count);
    }
    enhancer.share(team);
  }
}

float SummedCosts::unit() const {
  return kUnit;
}

void SummedCosts::compute(const Costs& block) const {
  if (block.queries == 0 || block.references == 0) return;
  // An enhancer takes all queries, and references from a multiple of kAlign on.
  const std::size_t first = block.first_reference / ContrastEnhancer::kAlign * ContrastEnhancer::kAlign,
                    count = block.first_reference + block.references - first;
  std::vector<float> values(queries() * count), sum(queries() * count);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Costs whole{0, queries(), first, count, values.data(), count};
    parts_[i].costs->compute(whole);
    enhancers_[i].enhance(whole);
    std::ranges::transform(values, sum, sum.begin(), std::plus{});
  }
  vo::parallel_for(block.queries, [&](std::size_t i) {
    const float* from = sum.data() + (block.first_query + i) * count + (block.first_reference - first);
    std::transform(from, from + block.references, block.row(i).begin(),
                   [](float z) { return std::max(0.0F, std::nearbyint((z + kLowest) / kUnit)) * kUnit; });
  });
}

}  // namespace place
