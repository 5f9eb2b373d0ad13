#pragma once

#include "place/candidates.hpp"
#include "place/contrast_enhancement.hpp"
#include "place/drift_correction.hpp"
#include "place/match.hpp"
#include "place/openseqslam.hpp"
#include "place/relative_scale.hpp"
#include "place/route_database.hpp"
#include "place/streamed_search.hpp"

#include <optional>
#include <string>
#include <vector>

#include <vo/base/progress.hpp>
#include <vo/walk_motion.hpp>

/// The whole library on one screen: a walk becomes keyframes, a first one becomes a route, another is found
/// on it.
namespace place {

/// Settings of `sample_walk`.
struct WalkSamplingOptions {
  vo::WalkMotionOptions motion;  ///< its `visual.patch` is overruled by the route's
  Sampling sampling;
  bool tie_scale = true;  ///< bring a walk to the spacing of the route's first traverse (`relative_scale`)
  RelativeScaleOptions relative_scale;
  /// The same where both walks are in metres: by their steps, whose lengths differ by a tenth or two where
  /// speeds differ by half.
  RelativeScaleOptions metric_scale{.prior_weight = 1};
};

/// A walk cut down to its keyframes.
struct SampledWalk {
  std::vector<std::size_t> frames;  ///< of the walk, strictly increasing
  std::vector<double>
      displacement;              ///< of every frame of the walk since the one before; empty without motion
  vo::ImageStack thumbnails;     ///< of the keyframes
  vo::MotionModel motion_model;  ///< of alignment error, learned on the walk; nothing in it without
  bool metric = false;           ///< the displacement came in metres
  vo::Trajectory trajectory;  ///< by that motion, at every frame; empty unless metres and headings are known
  double scale = 1;           ///< the displacement was multiplied by this to fit the route's
  double unit = 0;            ///< displacement between keyframes (SSS Eq. 4); 0 without motion
  std::vector<std::string> warnings;  ///< what a user should know of the motion and the keyframes
};

/// Samples a walk (SSS 3.3). With motion, the unit comes from `options.sampling.unit`, or where that is 0
/// from this walk by Eq. 4, or in metres `usual_spacing_m`. `reference`: the route's first traverse, to tie
/// the scale to; null for the first walk itself. Throws `vo::Error` naming the walk if it shows no motion to
/// learn from.
SampledWalk sample_walk(const vo::Walk& walk, const Route& route, const Traverse* reference,
                        const WalkSamplingOptions& options);

/// What poses and distances a walk's frames have, where they were surveyed (or its odometry, without
/// distances).
struct Survey {
  std::string source;                             ///< the file's name
  bool surveyed = true;                           ///< false: the walk's own odometry
  std::vector<std::optional<vo::Pose2>> pose;     ///< by frame
  std::vector<std::optional<double>> distance_m;  ///< by frame
};

/// Makes a traverse of a sampled walk. Throws `std::invalid_argument` if the survey is of another number of
/// frames.
Traverse make_traverse(const std::string& name, const vo::Walk& walk, const SampledWalk& sampled,
                       const std::optional<Survey>& survey);

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

/// Where accepted matches put a walk, for `correct_drift`, whose nodes are the query keyframes.
struct RouteFixes {
  std::vector<PoseFix> fixes;
  std::optional<std::size_t> traverse;  ///< the one that most of them are on; none without fixes
};

/// Poses of different surveys share their coordinates, but two walks' own odometry does not: fixes are on
/// surveyed traverses if any match is, else on the one that most matches are on. O(matches + traverses).
RouteFixes pose_fixes(const Route& route, const std::vector<Match>& matches);

}  // namespace place
