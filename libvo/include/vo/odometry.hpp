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

/// What a caller keeps of a frame beside all else, as bytes of its own meaning. Called for frames of a batch
/// at the same time.
using FrameRecorder = std::function<std::vector<std::uint8_t>(const Frame&)>;

/// Settings of `read_walk`.
struct WalkOptions {
  FrameSourceOptions frames;
  ThumbnailOptions thumbnail;
  int preview_width_px = 160;    ///< width of the small JPEG kept of every frame; 0 keeps none
  bool track_features = false;   ///< SURF points are followed, for `pedestrian_motion`
  bool visual_odometry = false;  ///< monocular visual odometry gives `Walk::track`
  FeatureTrackerOptions tracker;
  MonocularVoOptions vo;
  std::vector<FrameRecorder> recorders;  ///< each gives one of `Walk::records`
  int colour_width_px = 0;               ///< of `Frame::colour`, where recorders look at it
};

/// What one pass over a recording kept: about 2 kB a frame, 3 kB more with previews, 100 bytes with tracked
/// points.
struct Walk {
  std::string source;  ///< as given: a path, or camera:N
  int frame_width_px = 0;
  int frame_height_px = 0;
  std::vector<double> time_s;  ///< of each frame, since the first, strictly increasing
  std::vector<ClockGap> gaps;  ///< jumps of that clock, in order (`clock_gaps`)
  ImageStack thumbnails;       ///< grey, one for each frame
  std::vector<std::vector<std::uint8_t>>
      previews;                      ///< JPEG, one for each frame; empty if none were asked for
  std::vector<FrameMotion> tracked;  ///< by the points followed, one for each frame; empty if they were not
  /// By recorder, one for each frame.
  std::vector<std::vector<std::vector<std::uint8_t>>> records;
  std::optional<DisplacementTrack> track;  ///< by visual odometry or from a file, where there is one
  std::optional<double> start_utc_s;       ///< seconds since 1970 at the first frame, where its file says it
  std::vector<std::string> warnings;       ///< what a user should know of the recording

  [[nodiscard]] std::size_t frames() const { return time_s.size(); }
};

/// Reads a recording (see `open_frame_source` for its forms). Throws `vo::Error` if it cannot be read or has
/// fewer than two frames. Stops early, with what it has, when `progress` returns false. Reading is serial,
/// and goes on while the frames before are worked on in parallel.
Walk read_walk(const std::string& source, const WalkOptions& options = {},
               const ProgressCallback& progress = {});

/// The same of several files in order, as one walk.
Walk read_walk(std::span<const std::string> sources, const WalkOptions& options = {},
               const ProgressCallback& progress = {});

/// The same of frames from anywhere; `name` stands for them in messages.
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
  std::vector<bool> standing;        ///< the steps, among them, that are 0 because the walker stands
  MotionModel model;                 ///< learned on the whole walk
  AlignmentErrors errors;            ///< that all of this was learned from
  std::vector<bool> usable;  ///< false in windows of high error, of next to no contrast, and after a gap
};

/// Patch normalisation -> stands -> alignment errors -> windows of high error -> motion model, learned
/// without both -> displacement; over jumps of the clock that of the pace around them (`fill_gaps_by_pace`).
/// Throws `vo::Error` naming the walk if there is no motion to learn from (black, or standing still
/// throughout).
VisualMotion visual_motion(const Walk& walk, const VisualMotionOptions& options = {});

/// The same; none where there is no motion to learn from.
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
  StepSignal step_signal = StepSignal::kOrientation;  ///< which of them the steps were read from
  StepDetection detection;                            ///< in the signal's unit
  std::vector<double> step_length_m;                  ///< of each step
  std::vector<double> displacement_m;                 ///< of each frame since the one before it; the first: 0
  DeadReckoning trajectory;                           ///< from (0, 0), heading 0
  std::vector<ActivitySecond> activity;
};

/// Motion at even times -> gait signal -> steps -> step lengths -> displacement and trajectory, of a walk
/// read with `track_features`. In gaps of the clock steps are those of the way (`complete_steps`), in gaps
/// longer than `kLongestFilledGap_s` there are none. Throws `std::invalid_argument` for a walk without
/// tracked points, `vo::Error` naming one whose frame rate is too low to see steps.
PedestrianMotion pedestrian_motion(const Walk& walk, const PedestrianMotionOptions& options = {});

/// The same without its steps: what they were read from was no walker's.
PedestrianMotion without_steps(PedestrianMotion motion, const PedestrianMotionOptions& options = {});

}  // namespace vo
