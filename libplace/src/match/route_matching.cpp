#include "place/match/route_matching.hpp"

#include "place/match/cost_matrix.hpp"
#include "place/match/descriptor_costs.hpp"
#include "place/match/summed_costs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

/// Mean metres between neighbouring keyframes of a traverse.
double keyframe_spacing_m(const Traverse& traverse) {
  const Keyframe& first = traverse.keyframes.front();
  const Keyframe& last = traverse.keyframes.back();
  if (!first.distance_m || !last.distance_m || !(*last.distance_m > *first.distance_m)) {
    throw vo::Error(fmt::format("traverse '{}'", traverse.name), "has no surveyed distances",
                    "a surveyed route for a sequence length in metres");
  }
  return (*last.distance_m - *first.distance_m) / static_cast<double>(traverse.keyframes.size() - 1);
}

int sequence_length(const Traverse& traverse, const RouteMatchingOptions& options) {
  if (!options.sequence_length_m) return options.search.length;
  return std::max(1,
                  static_cast<int>(std::lround(*options.sequence_length_m / keyframe_spacing_m(traverse))));
}

void check_long_enough(const Traverse& traverse, int length) {
  if (traverse.keyframes.size() >= static_cast<std::size_t>(length)) return;
  throw vo::Error(fmt::format("traverse '{}'", traverse.name),
                  fmt::format("has {} keyframes, the sequence {}", traverse.keyframes.size(), length),
                  "a reference at least as long as the sequence; walk further or lower sequence-length");
}

/// A match before it is known which traverse counts.
struct Candidate {
  std::optional<std::size_t> keyframe;
  double score = 0;
  bool partial = false;
};

std::vector<std::size_t> counted(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

/// The references that are compared with: all, or of very many a shortlist.
std::vector<std::size_t> references_to_compare(const Descriptors& query, const Descriptors& reference,
                                               const RouteMatchingOptions& options, int length) {
  // A shortlist takes less than half as long as comparing all references with 400 queries
  // (tests/bench/README.md).
  constexpr std::size_t kManyQueries = 400, kManyReferences = 100'000;
  const bool many = count_of(query) >= kManyQueries && count_of(reference) >= kManyReferences;
  if (options.candidate_use == CandidateUse::kAlways ||
      (options.candidate_use == CandidateUse::kAuto && many)) {
    CandidateOptions settings = options.candidates;
    settings.margin = std::max(settings.margin, length);
    return candidates(query, reference, settings);
  }
  return counted(count_of(reference));
}

/// Two walks as they are compared, by each descriptor.
struct Compared {
  std::vector<Descriptors> query, reference;
  std::vector<std::size_t> columns;  ///< the traverse's keyframes that are compared with
};

Compared compared(const SampledWalk& sampled, const Traverse& traverse, const DescriptorSet& descriptors,
                  const RouteMatchingOptions& options, int length) {
  if (sampled.descriptors.size() != descriptors.size() || traverse.descriptors.size() != descriptors.size())
    throw std::invalid_argument("match_on_route: walks described by the given descriptors expected");
  Compared both;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    both.query.push_back(descriptors[i]->comparable(sampled.descriptors[i]));
    both.reference.push_back(descriptors[i]->comparable(traverse.descriptors[i]));
  }
  both.columns = references_to_compare(both.query.front(), both.reference.front(), options, length);
  if (both.columns.size() < count_of(both.reference.front()))
    for (Descriptors& reference : both.reference) reference = select(reference, both.columns);
  return both;
}

std::shared_ptr<const DescriptorSet> descriptors_of(const RouteMatchingOptions& options) {
  if (options.descriptors) return options.descriptors;
  return make_descriptors({.name = "thumbnail", .patch = options.patch});
}

/// The costs of one descriptor, or the sum of what several say.
std::unique_ptr<CostSource> costs_of(const Compared& both, const DescriptorSet& descriptors,
                                     std::optional<int> max_shift_px) {
  std::vector<SummedPart> parts;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const DescriptorTraits traits = descriptors[i]->traits();
    parts.push_back(
        {descriptor_costs(both.query[i], both.reference[i], traits, max_shift_px), traits.prior_queries});
  }
  if (parts.size() == 1) return std::move(parts.front().costs);
  return std::make_unique<SummedCosts>(std::move(parts));
}

std::vector<Candidate> search_our_way(const SampledWalk& sampled, const Traverse& traverse, std::size_t index,
                                      const RouteMatchingOptions& options, int length,
                                      const SearchCallback& callback) {
  const std::shared_ptr<const DescriptorSet> descriptors = descriptors_of(options);
  const Compared both = compared(sampled, traverse, *descriptors, options, length);
  const std::unique_ptr<CostSource> costs = costs_of(both, *descriptors, options.max_shift_px);
  const std::vector<std::size_t>& columns = both.columns;
  StreamedSearchOptions streamed{.cost = {}, .enhancement = options.enhancement, .search = options.search};
  streamed.enhancement.prior_queries = prior_queries_of(options);
  streamed.search.length = length;
  MatrixCallbacks callbacks;
  if (callback) {
    callbacks.cost = [&](const ConstCosts& part) { callback({index, false, part, columns}); };
    callbacks.enhanced = [&](const ConstCosts& part) { callback({index, true, part, columns}); };
  }
  std::vector<Candidate> found;
  for (const SequenceMatch& match : search_streamed(*costs, streamed, callbacks)) {  // SSS 3.4
    found.push_back({match.reference ? std::optional(columns[*match.reference]) : std::nullopt, match.score,
                     match.reference && match.terms < length});
  }
  return found;
}

std::vector<Candidate> search_the_original_way(const SampledWalk& sampled, const Traverse& traverse,
                                               std::size_t index, openseqslam::Options options, int length,
                                               const SearchCallback& callback) {
  options.sequence_length = length;
  const vo::ImageStack* const reference = thumbnails_of(traverse);
  if (reference == nullptr) {
    throw vo::Error(fmt::format("traverse '{}'", traverse.name), "was built without thumbnails",
                    "a route built with descriptor thumbnail, or with previews");
  }
  const CostMatrix cost =
      openseqslam::difference_matrix(openseqslam::patch_normalise(sampled.thumbnails, options),
                                     openseqslam::patch_normalise(*reference, options), options);
  const CostMatrix enhanced = openseqslam::enhance(cost, options);
  if (callback) {
    const std::vector<std::size_t> columns = counted(traverse.keyframes.size());
    callback({index, false, block_of(cost), columns});
    callback({index, true, block_of(enhanced), columns});
  }
  std::vector<Candidate> candidates;
  for (const openseqslam::Match& found : openseqslam::find_matches(enhanced, options)) {
    // The original's score is smaller for surer matches and lies in [0, 1].
    candidates.push_back(
        {found.reference, found.reference ? 1.0 - static_cast<double>(found.score) : 0, false});
  }
  return candidates;
}

Place place_of(const Traverse& traverse, std::size_t keyframe) {
  const Keyframe& k = traverse.keyframes[keyframe];
  return {.traverse = traverse.name,
          .keyframe = keyframe,
          .frame = k.frame,
          .time_s = k.time_s,
          .distance_m = k.distance_m,
          .pose = k.pose};
}

}  // namespace

CostMatrix cost_matrix_on_route(const SampledWalk& sampled, const Traverse& traverse,
                                const RouteMatchingOptions& options) {
  RouteMatchingOptions all = options;
  all.candidate_use = CandidateUse::kNever;
  const std::shared_ptr<const DescriptorSet> descriptors = descriptors_of(options);
  const Compared both = compared(sampled, traverse, *descriptors, all, 1);
  return cost_matrix(*costs_of(both, *descriptors, options.max_shift_px));
}

double prior_queries_of(const RouteMatchingOptions& options) {
  const std::shared_ptr<const DescriptorSet> descriptors = descriptors_of(options);
  double most = 0;
  for (const auto& descriptor : *descriptors) most = std::max(most, descriptor->traits().prior_queries);
  return most;
}

RouteMatches match_on_route(const Route& route, std::span<const double> time_s, const SampledWalk& sampled,
                            const RouteMatchingOptions& options, const SearchCallback& callback) {
  if (route.traverses.empty()) throw std::invalid_argument("match_on_route: the route has no traverse");
  RouteMatches result;
  for (const std::size_t frame : sampled.frames) {
    result.matches.push_back(
        {.query_frame = static_cast<std::int64_t>(frame), .query_time_s = time_s[frame], .place = {}});
  }
  for (std::size_t index = 0; index < route.traverses.size(); ++index) {
    const Traverse& traverse = route.traverses[index];
    const int length = sequence_length(traverse, options);
    check_long_enough(traverse, length);
    const std::vector<Candidate> candidates =
        options.openseqslam
            ? search_the_original_way(sampled, traverse, index, *options.openseqslam, length, callback)
            : search_our_way(sampled, traverse, index, options, length, callback);
    for (std::size_t q = 0; q < candidates.size(); ++q) {
      Match& match = result.matches[q];
      if (!candidates[q].keyframe || (match.place && match.score >= candidates[q].score)) continue;
      match.place = place_of(traverse, *candidates[q].keyframe);
      match.score = candidates[q].score;
      match.partial = candidates[q].partial;
      match.accepted = match.score >= options.accept_score;
    }
    result.sequence_length = length;
  }
  if (!options.openseqslam) {
    SequenceSearchOptions search = options.search;
    search.length = result.sequence_length;
    result.lines = static_cast<int>(search_lines(search).size());
  }
  return result;
}

}  // namespace place
