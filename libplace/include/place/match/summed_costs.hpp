#pragma once

#include "place/match/contrast_enhancement.hpp"
#include "place/match/costs.hpp"
#include "place/match/team.hpp"

#include <memory>
#include <vector>

namespace place {

/// A source of costs and the prior count of its standardisation
/// (`ContrastEnhancementOptions::prior_queries`).
struct SummedPart {
  std::unique_ptr<CostSource> costs;
  double prior_queries = 0;
};

/// The sum of several standardised matrices, which combines several descriptors. Shifted to be at least 0 and
/// rounded to 2^-10 of a deviation.
class SummedCosts final : public CostSource {
 public:
  /// Computes all costs once. Throws `std::invalid_argument` unless there are parts, all of one size.
  explicit SummedCosts(std::vector<SummedPart> parts);

  /// The same for a shard `own` of a reference of `total` keyframes: the parts' columns are numbered from
  /// keyframe `first` on. What standardises them is of the whole reference, from all members of the team.
  SummedCosts(std::vector<SummedPart> parts, std::size_t total, const Shard& own, std::size_t first,
              Team& team);

  [[nodiscard]] std::size_t queries() const override { return parts_.front().costs->queries(); }
  [[nodiscard]] std::size_t references() const override { return parts_.front().costs->references(); }
  [[nodiscard]] float unit() const override;
  /// A block of some queries costs as much as one of all.
  void compute(const Costs& block) const override;

 private:
  void survey(std::size_t total, const Shard& own, std::size_t first, Team& team);

  std::vector<SummedPart> parts_;
  std::vector<ContrastEnhancer> enhancers_;
};

}  // namespace place
