#pragma once

#include "place/match/route_matching.hpp"
#include "place/route/survey.hpp"
#include "place/route/walk_sampling.hpp"
#include "place/settings.hpp"

#include <string>

#include <vo/motion/external_trajectory.hpp>
#include <vo/odometry.hpp>

namespace place {

/// The options of every stage, as settings say. What a resolved setting has no value for is left at the
/// stage's own default.
struct StageOptions {
  vo::WalkOptions walk;
  std::string motion_file;                        ///< for motion by a file; else empty
  vo::PoseFileOptions motion_file_form;           ///< how it is read
  vo::ExternalTrajectoryOptions motion_file_fit;  ///< how it is matched to frames
  WalkSamplingOptions sampling;
  RouteMatchingOptions matching;
};

/// `resolved`: what `resolve` gave. `follow_steps`: points are tracked though the motion needs none. Reads
/// the camera's calibration file, if there is one. Throws `vo::Error` if it cannot be read.
StageOptions stage_options(const Settings& resolved, bool follow_steps = false);

/// How a survey's file is read, as far as it was given: `axes` and `motion-file-gap-s`, which a trajectory
/// that gives motion shares with one that was surveyed.
SurveyOptions survey_options(const Settings& given);

}  // namespace place
