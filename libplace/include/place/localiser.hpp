#pragma once

#include "place/match/candidates.hpp"
#include "place/match/contrast_enhancement.hpp"
#include "place/match/match.hpp"
#include "place/match/openseqslam.hpp"
#include "place/match/streamed_search.hpp"
#include "place/route/route_database.hpp"
#include "place/route/walk_sampling.hpp"
#include "place/trajectory/pose_fixes.hpp"

#include <optional>
#include <vector>

/// The whole library on one screen: a walk becomes keyframes (`walk_sampling`), a first one becomes a route,
/// another is found on it, and where it was found corrects its drift (`pose_fixes`, `drift_correction`).
namespace place {

/// Whether a walk is compared with all of a traverse or with a shortlist of it.
enum class CandidateUse {
  kAuto,    ///< a shortlist where walk and traverse are so long that it saves time
  kNever,   ///< always all
  kAlways,  ///< always a shortlist
};

/// Settings of `localise`.
struct LocaliserOptions {
  CandidateUse candidate_use = CandidateUse::kAuto;
  CandidateOptions candidates;  ///< its margin is widened to half a line
  CostOptions cost;
  ContrastEnhancementOptions enhancement;
  SequenceSearchOptions search;
  std::optional<double>
      sequence_length_m;  ///< metres on a line, instead of `search.length`; needs surveyed distances
  double acceptance_threshold =
      0.7;  ///< least score of an accepted match, in deviations of the enhanced cost
  std::optional<openseqslam::Options> openseqslam;  ///< run the original's search instead of ours
  bool whole_matrices = false;  ///< keep every cell of `Localisation::matrices`, however many there are
};

/// The matrices of a search against one traverse, for people to look at.
struct SearchMatrices {
  CostMatrix cost;
  CostMatrix enhanced;
  std::size_t shrink = 1;  ///< a cell is the least of so many by so many, where the matrix is a large one;
                           ///< infinite where no pair of them was compared
};
inline constexpr std::size_t kLargestMatrix = 1024;  ///< cells along a side, above which it is shrunk

/// Where a walk was found on a route.
struct Localisation {
  std::vector<Match> matches;            ///< one for each query keyframe, in order
  std::vector<SearchMatrices> matrices;  ///< one for each traverse
  int sequence_length = 0;               ///< keyframes, as used
  int lines = 0;  ///< distinct lines searched through each pair; 0 in OpenSeqSLAM's search
};

/// Finds a sampled walk on a route: descriptors -> cost matrix -> contrast enhancement -> sequence search,
/// against each traverse by itself; of a route's traverses the one with the surest match counts. Throws
/// `vo::Error` naming the traverse if it is shorter than the sequence, or has no distances where a length in
/// metres asks for them.
Localisation localise(const Route& route, const vo::Walk& walk, const SampledWalk& sampled,
                      const LocaliserOptions& options);

}  // namespace place
