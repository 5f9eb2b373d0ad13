#pragma once

#include "place/certainty/sure_search.hpp"
#include "place/match/candidates.hpp"
#include "place/match/contrast_enhancement.hpp"
#include "place/match/match.hpp"
#include "place/match/openseqslam.hpp"
#include "place/match/search_method.hpp"
#include "place/route/route.hpp"
#include "place/route/walk_sampling.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vo/image/patch_normalisation.hpp>

namespace place {

/// Whether a walk is compared with all of a traverse or with a shortlist of it.
enum class CandidateUse {
  kAuto,    ///< a shortlist where walk and traverse are long enough to save time
  kNever,   ///< always all
  kAlways,  ///< always a shortlist
};

class TraverseSearch;

/// Settings of `match_on_route`.
struct RouteMatchingOptions {
  CandidateUse candidate_use = CandidateUse::kAuto;
  CandidateOptions candidates;  ///< its margin is widened to half a line
  /// What keyframes were described with; null: thumbnails, by `patch`.
  std::shared_ptr<const DescriptorSet> descriptors;
  vo::PatchNormalisationOptions patch;
  std::optional<int> max_shift_px;  ///< see `descriptor_costs`
  ContrastEnhancementOptions enhancement;
  SequenceSearchOptions search;
  /// Length of a line in metres, instead of `search.length`; needs surveyed distances.
  std::optional<double> sequence_length_m;
  std::string method = "path";  ///< one of `search_methods`
  /// Join the traverses' costs for each place (`fuse_traverses`); otherwise each is searched by itself.
  bool fuse_traverses = true;
  double accept_probability = 0.95;                 ///< least probability of an accepted match
  std::optional<double> accept_score;               ///< least score instead
  std::optional<openseqslam::Options> openseqslam;  ///< run the original's search instead of ours
  TraverseSearch* traverse_search = nullptr;        ///< searches traverses that are not in memory; null: here
};

/// Searches traverses whose descriptors are not in memory (`StoredSearch`).
class TraverseSearch {
 public:
  virtual ~TraverseSearch() = default;

  /// Called first. Throws `vo::Error` for settings that it cannot do.
  virtual void prepare(const Settings& resolved, const Route& route) = 0;
  /// The costs of a walk's first descriptors, comparable, by which its scale is tied to a traverse.
  virtual CostMatrix scale_costs(std::size_t traverse, const Descriptors& query) = 0;
  /// What was found, and the traverse's keyframe of every column.
  struct Found {
    std::vector<std::size_t> columns;
    SureMatches matches;
  };
  /// `search`: of `search_on_route`.
  virtual Found search(std::size_t traverse, const SampledWalk& sampled, const SearchOptions& search) = 0;
};

/// A part of the matrices of a search against one traverse: all queries by some of its keyframes.
struct SearchPart {
  std::size_t traverse = 0;                 ///< of the route
  bool enhanced = false;                    ///< false: plain costs
  ConstCosts costs;                         ///< its columns are numbered ...
  std::span<const std::size_t> references;  ///< ... by this: the traverse's keyframe of every column
};

/// Receives the matrices of a search, to keep or draw them.
using SearchCallback = std::function<void(const SearchPart&)>;

/// Where a walk was found on a route.
struct RouteMatches {
  std::vector<Match> matches;  ///< one for each query keyframe, in order
  int sequence_length = 0;     ///< keyframes, as used
  int lines = 0;               ///< distinct lines searched through each pair; 0 unless lines are searched
  /// The source of probabilities, the estimated share of wrong matches, and the share of cells looked at, for
  /// the traverse with most matches.
  ProbabilitySource probability_source = ProbabilitySource::kNone;
  double wrong_share = 1, looked_at = 1;
  std::vector<std::string> warnings;  ///< what a user should know about traverses that share no place
};

/// The whole cost matrix of a sampled walk and a traverse, as `match_on_route` would search it. Throws
/// `std::invalid_argument` for walks that were not described with the options' descriptors.
CostMatrix cost_matrix_on_route(const SampledWalk& sampled, const Traverse& traverse,
                                const RouteMatchingOptions& options);

/// The prior count of the standardisation of those costs (`ContrastEnhancementOptions::prior_queries`).
double prior_queries_of(const RouteMatchingOptions& options);

/// The options for searching a walk on a traverse: sequences of the length asked for, the walk's own
/// displacement between its keyframes (for `search_path`, in keyframes of the traverse), and where the clock
/// of either jumped for so long that the distance is unknown (`vo::parts_walk`). `time_s`: of the walk's
/// frames. Throws `vo::Error` for a length in metres on a traverse without distances.
SearchOptions search_on_route(const Traverse& traverse, std::span<const double> time_s,
                              const SampledWalk& sampled, const RouteMatchingOptions& options);

/// Finds a sampled walk on a route: descriptors -> cost matrix -> contrast enhancement -> fusion with the
/// other traverses -> search with certainty (`search_surely`), against each traverse; the traverse with the
/// surest match counts. In a walk too short for probabilities, matches are accepted by score, from 0.7
/// deviations of the enhanced cost. No sequence crosses a gap of the walk or of a traverse, except in
/// OpenSeqSLAM's search, which equals the original's to the bit and ignores time.
///
/// Fusion needs to know where traverses overlap, and finds that the same way as it finds the walk. Memory: 4
/// bytes for each pair of keyframes, twice, and for all traverses if they are joined. `time_s`: of the walk's
/// frames. Throws `vo::Error` naming the traverse if it is shorter than the sequence, or has no distances but
/// a length in metres is given, or no thumbnails for OpenSeqSLAM's search; `std::invalid_argument` for a
/// route without traverses.
RouteMatches match_on_route(const Route& route, std::span<const double> time_s, const SampledWalk& sampled,
                            const RouteMatchingOptions& options, const SearchCallback& callback = {});

}  // namespace place
