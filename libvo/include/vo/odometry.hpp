#pragma once

#include "vo/base/clock.hpp"
#include "vo/base/progress.hpp"
#include "vo/gait/activity.hpp"
#include "vo/gait/dead_reckoning.hpp"
#include "vo/gait/even_motion.hpp"
#include "vo/gait/gait_signal.hpp"
#include "vo/gait/step_length.hpp"
#include "vo/gait/step_reading.hpp"
#include "vo/image/image_stack.hpp"
#include "vo/image/patch_normalisation.hpp"
#include "vo/image/thumbnail.hpp"
#include "vo/io/frame_source.hpp"
#include "vo/motion/alignment_error.hpp"
#include "vo/motion/displacement_track.hpp"
#include "vo/motion/motion_model.hpp"
#include "vo/motion/standing.hpp"
#include "vo/tracks/feature_tracker.hpp"
#include "vo/visual_odometry/monocular_vo.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The whole library on one screen: a walk is read once, and every later stage works on what that pass kept.
namespace vo {

/// What a caller additionally keeps of a frame, as bytes in its own format. Called concurrently for the
/// frames of a batch.
using FrameRecorder = std::function<std::vector<std::uint8_t>(const Frame&)>;

/// Settings of `read_walk`.
struct WalkOptions {
  FrameSourceOptions frames;
  ThumbnailOptions thumbnail;
  int preview_width_px = 160;    ///< width of the small JPEG kept of every frame; 0 keeps none
  bool track_features = false;   ///< track SURF points, for `pedestrian_motion`
  bool visual_odometry = false;  ///< fill `Walk::track` by monocular visual odometry
  FeatureTrackerOptions tracker;
  MonocularVoOptions vo;
  std::vector<FrameRecorder> recorders;  ///< each gives one of `Walk::records`
  int colour_width_px = 0;               ///< of `Frame::colour`, if recorders use it
};

/// What one pass over a recording kept: about 2 kB per frame, 3 kB more with previews, 100 bytes more with
/// tracked points.
struct Walk {
  std::string source;  ///< as given: a path, or camera:N
  int frame_width_px = 0;
  int frame_height_px = 0;
  std::vector<double> time_s;  ///< of each frame, since the first, strictly increasing
  std::vector<ClockGap> gaps;  ///< jumps of that clock, in order (`clock_gaps`)
  ImageStack thumbnails;       ///< grey, one for each frame
  std::vector<std::vector<std::uint8_t>>
      previews;                      ///< JPEG, one for each frame; empty if none were asked for
  std::vector<FrameMotion> tracked;  ///< from tracked points, one for each frame; empty without
  /// For each recorder, one for each frame.
  std::vector<std::vector<std::vector<std::uint8_t>>> records;
  std::optional<DisplacementTrack> track;  ///< by visual odometry or from a file, if any
  std::optional<double> start_utc_s;       ///< seconds since 1970 at the first frame, if its file says so
  std::vector<std::string> warnings;       ///< what a user should know about the recording

  [[nodiscard]] std::size_t frames() const { return time_s.size(); }
};

/// Reads a recording (see `open_frame_source` for its forms). Throws `vo::Error` if it cannot be read or has
/// fewer than two frames. Stops early, with the frames so far, when `progress` returns false. Reading is
/// serial, while earlier frames are processed in parallel.
Walk read_walk(const std::string& source, const WalkOptions& options = {},
               const ProgressCallback& progress = {});

/// The same for several files in order, as one walk.
Walk read_walk(std::span<const std::string> sources, const WalkOptions& options = {},
               const ProgressCallback& progress = {});

/// The same for frames from any source; messages call it `name`.
Walk read_walk(FrameSource& frames, const std::string& name, const WalkOptions& options = {},
               const ProgressCallback& progress = {});

/// Settings of `visual_motion`.
struct VisualMotionOptions {
  PatchNormalisationOptions patch;
  AlignmentErrorOptions alignment;
  MotionModelOptions model;
  StandingOptions standing;
  double min_contrast = 0.25;  ///< share of the walk's median, below which a picture shows too little
};

/// The displacement of every frame since the one before it (the first: 0), from alignment error
/// (SSS 3.1-3.2).
struct VisualMotion {
  std::vector<double> displacement;  ///< seconds at mean walking speed
  std::vector<bool> standing;        ///< displacements that are 0 because the walker is still
  MotionModel model;                 ///< learned on the whole walk
  AlignmentErrors errors;            ///< the errors that all of this was learned from
  std::vector<bool> usable;  ///< false in windows of high error, with hardly any contrast, and after a gap
};

/// Patch normalisation -> pauses -> alignment errors -> windows of high error -> motion model, learned
/// without pauses and those windows -> displacement; over jumps of the clock at the pace around them
/// (`fill_gaps_by_pace`). Throws `vo::Error` naming the walk if there is no motion to learn from (black, or
/// still throughout).
VisualMotion visual_motion(const Walk& walk, const VisualMotionOptions& options = {});

/// The same; none if there is no motion to learn from.
std::optional<VisualMotion> visual_motion_if_any(const Walk& walk, const VisualMotionOptions& options = {});

/// Settings of `pedestrian_motion`.
struct PedestrianMotionOptions {
  GaitSignalOptions signal;
  StepReadingOptions steps;
  StepLengthOptions step_length;
  DeadReckoningOptions dead_reckoning;
  ActivityOptions activity;
};

/// Steps, heading and trajectory of a walk (PVO 4), at its frames.
struct PedestrianMotion {
  GaitSignal signal;
  StepSignal step_signal = StepSignal::kOrientation;  ///< that the steps were read from
  StepDetection detection;                            ///< in the signal's unit
  std::vector<double> step_length_m;                  ///< of each step
  std::vector<double> displacement_m;                 ///< of each frame since the one before it; the first: 0
  DeadReckoning trajectory;                           ///< from (0, 0), heading 0
  std::vector<ActivitySecond> activity;
};

/// Motion at even times -> gait signal -> steps -> step lengths -> displacement and trajectory, for a walk
/// read with `track_features`. In gaps of the clock, steps follow from the distance (`complete_steps`); in
/// gaps longer than `kLongestFilledGap_s` there are none. Throws `std::invalid_argument` for a walk without
/// tracked points, `vo::Error` naming one whose frame rate is too low to see steps.
PedestrianMotion pedestrian_motion(const Walk& walk, const PedestrianMotionOptions& options = {});

/// The same without its steps, for a signal that was not a walker's.
PedestrianMotion without_steps(PedestrianMotion motion, const PedestrianMotionOptions& options = {});

/// The step length with which the steps of a walk of known length, above 0, add up to it
/// (`calibrated_step_length_m` of numbers); none if the walk shows no steps. Throws as `pedestrian_motion`.
std::optional<double> calibrated_step_length_m(const Walk& walk, double length_m,
                                               const PedestrianMotionOptions& options = {});

}  // namespace vo
