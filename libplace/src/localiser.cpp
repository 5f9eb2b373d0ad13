#include "place/localiser.hpp"

#include "place/match/cost_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace place {
namespace {

/// Mean metres between neighbouring keyframes of a traverse.
double keyframe_spacing_m(const Traverse& traverse) {
  const Keyframe& first = traverse.keyframes.front();
  const Keyframe& last = traverse.keyframes.back();
  if (!first.distance_m || !last.distance_m || !(*last.distance_m > *first.distance_m)) {
    throw vo::Error(fmt::format("traverse '{}'", traverse.name), "has no surveyed distances",
                    "a route built with --truth or --trajectory for a sequence length in metres");
  }
  return (*last.distance_m - *first.distance_m) / static_cast<double>(traverse.keyframes.size() - 1);
}

int sequence_length(const Traverse& traverse, const LocaliserOptions& options) {
  if (!options.sequence_length_m) return options.search.length;
  return std::max(1,
                  static_cast<int>(std::lround(*options.sequence_length_m / keyframe_spacing_m(traverse))));
}

void check_long_enough(const Traverse& traverse, int length) {
  if (traverse.keyframes.size() >= static_cast<std::size_t>(length)) return;
  throw vo::Error(fmt::format("traverse '{}'", traverse.name),
                  fmt::format("has {} keyframes, the sequence {}", traverse.keyframes.size(), length),
                  "a reference at least as long as the sequence; walk further or lower --sequence-length");
}

/// A match before it is known which traverse counts.
struct Candidate {
  std::optional<std::size_t> keyframe;
  double score = 0;
  bool partial = false;
};

/// Puts a part of a matrix into one of which every cell is the least of `shrink` queries by the references
/// that have its number in `cell_of`, which never decreases.
void shrink_part(const ConstCosts& part, const std::vector<std::size_t>& cell_of, std::size_t shrink,
                 CostMatrix& shrunk) {
  vo::parallel_for(shrunk.queries, [&](std::size_t cell_row) {
    const std::span<float> cells = shrunk.row(cell_row);
    for (std::size_t q = cell_row * shrink; q < std::min(part.queries, (cell_row + 1) * shrink); ++q) {
      const std::span<const float> row = part.row(q);
      const std::size_t* cell = cell_of.data() + part.first_reference;
      for (std::size_t i = 0; i < row.size();) {
        const std::size_t same = cell[i];
        float least = cells[same];
        for (; i < row.size() && cell[i] == same; ++i) least = std::min(least, row[i]);
        cells[same] = least;
      }
    }
  });
}

/// The references that are compared with: all, or of very many a shortlist.
std::vector<std::size_t> references_to_compare(const vo::ImageStack& query, const vo::ImageStack& reference,
                                               const LocaliserOptions& options, int length) {
  // A shortlist takes less than half as long as comparing all references with 400 queries
  // (tests/bench/README.md).
  constexpr std::size_t kManyQueries = 400, kManyReferences = 100'000;
  const bool many = query.size() >= kManyQueries && reference.size() >= kManyReferences;
  if (options.candidate_use == CandidateUse::kAlways ||
      (options.candidate_use == CandidateUse::kAuto && many)) {
    CandidateOptions settings = options.candidates;
    settings.margin = std::max(settings.margin, length);
    return candidates(query, reference, settings);
  }
  std::vector<std::size_t> all(reference.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::vector<Candidate> search_our_way(const vo::ImageStack& query_thumbnails,
                                      const vo::ImageStack& reference_thumbnails, const Route& route,
                                      const LocaliserOptions& options, int length, SearchMatrices& matrices) {
  const vo::ImageStack query = vo::patch_normalise(query_thumbnails, route.patch);
  vo::ImageStack reference = vo::patch_normalise(reference_thumbnails, route.patch);
  const auto parts = [](std::size_t count, std::size_t of) { return (count + of - 1) / of; };
  if (!options.whole_matrices)
    matrices.shrink =
        std::max<std::size_t>(1, parts(std::max(query.size(), reference.size()), kLargestMatrix));
  for (CostMatrix* matrix : {&matrices.cost, &matrices.enhanced}) {
    *matrix =
        make_cost_matrix(parts(query.size(), matrices.shrink), parts(reference.size(), matrices.shrink));
    std::ranges::fill(matrix->values, std::numeric_limits<float>::infinity());
  }
  const std::vector<std::size_t> columns = references_to_compare(query, reference, options, length);
  if (columns.size() < reference.size()) reference = vo::select(reference, columns);
  StreamedSearchOptions streamed{
      .cost = options.cost, .enhancement = options.enhancement, .search = options.search};
  streamed.search.length = length;
  std::vector<std::size_t> cell_of;
  for (const std::size_t column : columns) cell_of.push_back(column / matrices.shrink);
  const auto keep_in = [&](CostMatrix& matrix) {
    return [&](const ConstCosts& part) { shrink_part(part, cell_of, matrices.shrink, matrix); };
  };
  const MatrixCallbacks keep{keep_in(matrices.cost), keep_in(matrices.enhanced)};
  std::vector<Candidate> found;
  for (const SequenceMatch& match : search_streamed(query, reference, streamed, keep)) {  // SSS 3.4
    found.push_back({match.reference ? std::optional(columns[*match.reference]) : std::nullopt, match.score,
                     match.reference && match.terms < length});
  }
  return found;
}

std::vector<Candidate> search_the_original_way(const vo::ImageStack& query, const vo::ImageStack& reference,
                                               const openseqslam::Options& options,
                                               SearchMatrices& matrices) {
  matrices.cost = openseqslam::difference_matrix(openseqslam::patch_normalise(query, options),
                                                 openseqslam::patch_normalise(reference, options), options);
  matrices.enhanced = openseqslam::enhance(matrices.cost, options);
  std::vector<Candidate> candidates;
  for (const openseqslam::Match& found : openseqslam::find_matches(matrices.enhanced, options)) {
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

Localisation localise(const Route& route, const vo::Walk& walk, const SampledWalk& sampled,
                      const LocaliserOptions& options) {
  if (route.traverses.empty()) throw std::invalid_argument("localise: the route has no traverse");
  Localisation result;
  for (const std::size_t frame : sampled.frames) {
    Match match;
    match.query_frame = static_cast<std::int64_t>(frame);
    match.query_time_s = walk.time_s[frame];
    result.matches.push_back(std::move(match));
  }
  for (const Traverse& traverse : route.traverses) {
    const int length = sequence_length(traverse, options);
    check_long_enough(traverse, length);
    SearchMatrices& matrices = result.matrices.emplace_back();
    std::vector<Candidate> candidates;
    if (options.openseqslam) {
      openseqslam::Options original = *options.openseqslam;
      original.sequence_length = length;
      candidates = search_the_original_way(sampled.thumbnails, traverse.thumbnails, original, matrices);
    } else {
      candidates = search_our_way(sampled.thumbnails, traverse.thumbnails, route, options, length, matrices);
    }
    for (std::size_t q = 0; q < candidates.size(); ++q) {
      Match& match = result.matches[q];
      if (!candidates[q].keyframe || (match.place && match.score >= candidates[q].score)) continue;
      match.place = place_of(traverse, *candidates[q].keyframe);
      match.score = candidates[q].score;
      match.partial = candidates[q].partial;
      match.accepted = match.score >= options.acceptance_threshold;
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
