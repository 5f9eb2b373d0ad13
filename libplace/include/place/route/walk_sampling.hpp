#pragma once

#include "place/describe/descriptor.hpp"
#include "place/match/cost_matrix.hpp"
#include "place/route/relative_scale.hpp"
#include "place/route/route.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vo/base/trajectory.hpp>
#include <vo/image/image_stack.hpp>
#include <vo/motion/walk_motion.hpp>

namespace place {

/// Seconds of walking for which views should have something in common, for their motion to be learned well:
/// five of the spans of 0.04 s over which frames are compared, less rounding.
inline constexpr double kLeastCommonView_s = 0.19;

/// Settings of `sample_walk`.
struct WalkSamplingOptions {
  vo::WalkMotionOptions motion;
  vo::MotionSource source = vo::MotionSource::kSad;
  int every = 1;                    ///< frames between keyframes, with `kNone`
  std::optional<double> n;          ///< SSS Eq. 4's n, with motion
  std::optional<double> spacing_m;  ///< u in metres, instead of Eq. 4, if the motion is metric
  bool tie_scale = true;  ///< scale a walk to the spacing of the route's traverses (`relative_scale`)
  /// What keyframes are described with; null: thumbnails, with the motion's patches.
  std::shared_ptr<const DescriptorSet> descriptors;
  std::optional<int> max_shift_px;  ///< see `descriptor_costs`
  /// Which of the walk's records are its frames' SURF points (`vo::pack_view_points`); none: they were not
  /// kept.
  std::optional<std::size_t> points_record;
  RelativeScaleOptions relative_scale;
  /// The costs of a walk's first descriptors, comparable, against a traverse, for `tie_scale`; empty: of its
  /// descriptors in memory.
  std::function<CostMatrix(std::size_t traverse, const Descriptors& query)> scale_costs;
  /// The same if both walks are in metres, from steps: their lengths differ by a tenth or two where speeds
  /// differ by half.
  RelativeScaleOptions metric_scale{.prior_weight = 1};
};

/// A walk reduced to its keyframes.
struct SampledWalk {
  std::vector<std::size_t> frames;  ///< of the walk, strictly increasing
  std::vector<double>
      displacement;           ///< of every frame of the walk since the one before; empty without motion
  vo::ImageStack thumbnails;  ///< of the keyframes
  std::vector<Descriptors> descriptors;  ///< of the keyframes, for each of the descriptors
  std::vector<Bytes> learned;            ///< used by the descriptors: the route's, or from this walk
  std::vector<Bytes> view_points;        ///< of the keyframes (`vo::pack_view_points`); empty if not kept
  vo::MotionModel motion_model;          ///< of alignment error, learned on the walk; empty without
  bool metric = false;                   ///< the displacement was in metres
  vo::Trajectory trajectory;  ///< by that motion, at every frame; empty unless metres and headings are known
  double scale = 1;           ///< the displacement was multiplied by this to fit the route's
  double scale_gain = 0;      ///< certainty of the best scale, used or not (`RelativeScale::gain`)
  double unit = 0;            ///< displacement between keyframes (SSS Eq. 4); 0 without motion
  std::vector<std::string> warnings;  ///< what a user should know about the motion and keyframes
};

/// Samples a walk (SSS 3.3) and describes its keyframes. With motion, keyframes are a unit of displacement
/// apart: `spacing_m` if the motion is metric, else from Eq. 4 with `n`. A walk on a route uses the unit of
/// the route's first traverse, adjusted in proportion if its own `n` or `spacing_m` differs from the route's,
/// and its scale is tied to the traverse that it fits best, if the matches show it clearly (`RelativeScale`):
/// others may be of another stretch or another light. After a gap too long to fill (`vo::parts_walk`), whose
/// distance is unknown, sampling restarts. `route`: null, or without traverses, for a first walk, which the
/// descriptors learn from.
///
/// Throws `vo::Error` naming the walk if it shows no motion to learn from, or has no metres but only
/// `spacing_m` is given; `std::invalid_argument` if neither is, or if the walk was read without what the
/// descriptors record.
SampledWalk sample_walk(const vo::Walk& walk, const WalkSamplingOptions& options,
                        const Route* route = nullptr);

/// The surveyed poses and distances of a walk's frames (or its odometry, without distances).
struct Survey {
  std::string source;                             ///< the file's name
  bool surveyed = true;                           ///< false: the walk's own odometry
  std::vector<std::optional<vo::Pose2>> pose;     ///< by frame
  std::vector<std::optional<double>> distance_m;  ///< by frame
  std::vector<std::string> warnings;              ///< what a user should know about the file
};

/// Makes a traverse of a sampled walk. Throws `std::invalid_argument` if the survey has another number of
/// frames.
Traverse make_traverse(const std::string& name, const vo::Walk& walk, const SampledWalk& sampled,
                       const std::optional<Survey>& survey);

}  // namespace place
