#pragma once

#include "place/route/relative_scale.hpp"
#include "place/route/route_database.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <vo/base/trajectory.hpp>
#include <vo/image/image_stack.hpp>
#include <vo/motion/walk_motion.hpp>

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

}  // namespace place
