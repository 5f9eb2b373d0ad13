#pragma once

#include "place/match/route_matching.hpp"
#include "place/route/survey.hpp"
#include "place/route/walk_sampling.hpp"
#include "place/settings.hpp"

#include <optional>
#include <string>

#include <vo/motion/external_trajectory.hpp>
#include <vo/odometry.hpp>

namespace place {

/// The options of every stage, from settings. Where a resolved setting has no value, the stage's own default
/// stays.
struct StageOptions {
  vo::WalkOptions walk;
  std::string motion_file;                        ///< for motion from a file; else empty
  vo::PoseFileOptions motion_file_form;           ///< how it is read
  vo::ExternalTrajectoryOptions motion_file_fit;  ///< how it is matched to frames
  WalkSamplingOptions sampling;
  RouteMatchingOptions matching;
  int verify = 0;  ///< reference keyframes about a match to look at again (`verify_matches`)
};

/// `resolved`: from `resolve`. `follow_steps`: points are tracked even if the motion does not need them.
/// Reads the camera's calibration file, if there is one. Throws `vo::Error` if it cannot be read.
StageOptions stage_options(const Settings& resolved, bool follow_steps = false);

/// How a survey's file is read, as far as given: `axes` and `motion-file-gap-s`, which surveys share with
/// trajectories that give motion.
SurveyOptions survey_options(const Settings& given);

/// The settings of a walk that is surveyed by a trajectory or a track: without those that the survey takes
/// (`survey_options`), unless motion comes from a file too. `motion_of_route`: what the route fixes, if any.
Settings settings_beside_survey(Settings given, bool by_trajectory, bool by_track,
                                const std::optional<std::string>& motion_of_route);

}  // namespace place
