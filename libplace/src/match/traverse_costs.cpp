#include "match/traverse_costs.hpp"

#include "place/match/candidates.hpp"
#include "place/match/descriptor_costs.hpp"
#include "place/match/summed_costs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

/// Mean metres between neighbouring keyframes of a traverse.
double keyframe_spacing_m(const Traverse& traverse) {
  if (traverse.keyframes.size() < 2)
    throw vo::Error(fmt::format("traverse '{}'", traverse.name), "has no two keyframes", "a longer walk");
  const Keyframe& first = traverse.keyframes.front();
  const Keyframe& last = traverse.keyframes.back();
  if (!first.distance_m || !last.distance_m || !(*last.distance_m > *first.distance_m)) {
    throw vo::Error(fmt::format("traverse '{}'", traverse.name), "has no surveyed distances",
                    "a surveyed route for a sequence length in metres");
  }
  return (*last.distance_m - *first.distance_m) / static_cast<double>(traverse.keyframes.size() - 1);
}

/// The references to compare with: all, or a shortlist of very many.
std::vector<std::size_t> references_to_compare(const Descriptors& query, const Descriptors& reference,
                                               const RouteMatchingOptions& options, int length) {
  if (uses_shortlist(options, count_of(query), count_of(reference))) {
    CandidateOptions settings = options.candidates;
    settings.margin = std::max(settings.margin, length);
    return candidates(query, reference, settings);
  }
  return counted(count_of(reference));
}

std::shared_ptr<const DescriptorSet> descriptors_of(const RouteMatchingOptions& options) {
  if (options.descriptors) return options.descriptors;
  return make_descriptors({.name = "thumbnail", .patch = options.patch});
}

}  // namespace

void standardise_as_a_whole(CostMatrix& costs) {
  const double mean = range_of(costs.values).centre;
  double variance = 0;
  for (const float cost : costs.values)
    variance += (static_cast<double>(cost) - mean) * (static_cast<double>(cost) - mean);
  variance /= static_cast<double>(std::max<std::size_t>(1, costs.values.size()));
  const double scale = variance > 0 ? 1 / std::sqrt(variance) : 0;
  for (float& cost : costs.values) cost = static_cast<float>((static_cast<double>(cost) - mean) * scale);
}

bool uses_shortlist(const RouteMatchingOptions& options, std::size_t queries, std::size_t references) {
  // A shortlist takes less than half as long as comparing all references with 400 queries
  // (tests/bench/README.md).
  constexpr std::size_t kManyQueries = 400, kManyReferences = 100'000;
  if (options.candidate_use != CandidateUse::kAuto) return options.candidate_use == CandidateUse::kAlways;
  return queries >= kManyQueries && references >= kManyReferences;
}

std::vector<std::size_t> counted(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

int sequence_length_on(const Traverse& traverse, const RouteMatchingOptions& options) {
  if (!options.sequence_length_m) return options.search.length;
  return std::max(1,
                  static_cast<int>(std::lround(*options.sequence_length_m / keyframe_spacing_m(traverse))));
}

ComparedWalks compared_walks(const SampledWalk& sampled, const Traverse& traverse,
                             const RouteMatchingOptions& options, int length) {
  const std::shared_ptr<const DescriptorSet> descriptors = descriptors_of(options);
  if (sampled.descriptors.size() != descriptors->size() || traverse.descriptors.size() != descriptors->size())
    throw std::invalid_argument("match_on_route: walks described by the given descriptors expected");
  ComparedWalks both;
  for (std::size_t i = 0; i < descriptors->size(); ++i) {
    both.query.push_back((*descriptors)[i]->comparable(sampled.descriptors[i]));
    both.reference.push_back((*descriptors)[i]->comparable(traverse.descriptors[i]));
  }
  both.columns = references_to_compare(both.query.front(), both.reference.front(), options, length);
  if (both.columns.size() < count_of(both.reference.front()))
    for (Descriptors& reference : both.reference) reference = select(reference, both.columns);
  std::vector<SummedPart> parts;
  for (std::size_t i = 0; i < descriptors->size(); ++i) {
    const DescriptorTraits traits = (*descriptors)[i]->traits();
    parts.push_back({descriptor_costs(both.query[i], both.reference[i], traits, options.max_shift_px),
                     traits.prior_queries});
  }
  both.costs =
      parts.size() == 1 ? std::move(parts.front().costs) : std::make_unique<SummedCosts>(std::move(parts));
  return both;
}

TraverseCosts costs_against(const SampledWalk& sampled, const Traverse& traverse, std::size_t index,
                            const RouteMatchingOptions& options, int length, const SearchCallback& callback) {
  ComparedWalks both = compared_walks(sampled, traverse, options, length);
  TraverseCosts costs{std::move(both.columns), cost_matrix(*both.costs)};
  enhance_compared(costs, index, options, callback);
  return costs;
}

void enhance_compared(TraverseCosts& costs, std::size_t index, const RouteMatchingOptions& options,
                      const SearchCallback& callback) {
  if (callback) callback({index, false, block_of(std::as_const(costs.enhanced)), costs.columns});
  ContrastEnhancementOptions enhancement = options.enhancement;
  enhancement.prior_queries = prior_queries_of(options);
  enhance_contrast(costs.enhanced, enhancement);
  if (callback) callback({index, true, block_of(std::as_const(costs.enhanced)), costs.columns});
  if (options.enhancement.method == Enhancement::kNone) standardise_as_a_whole(costs.enhanced);
}

CostMatrix cost_matrix_on_route(const SampledWalk& sampled, const Traverse& traverse,
                                const RouteMatchingOptions& options) {
  RouteMatchingOptions all = options;
  all.candidate_use = CandidateUse::kNever;
  return cost_matrix(*compared_walks(sampled, traverse, all, 1).costs);
}

double prior_queries_of(const RouteMatchingOptions& options) {
  const std::shared_ptr<const DescriptorSet> descriptors = descriptors_of(options);
  double most = 0;
  for (const auto& descriptor : *descriptors) most = std::max(most, descriptor->traits().prior_queries);
  return most;
}

}  // namespace place
