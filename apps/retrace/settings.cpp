#include "settings.hpp"

#include "choice.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/camera_calibration.hpp>

namespace retrace {
namespace {

constexpr const char* kFrames = "Frames and descriptors";
constexpr const char* kSampling = "Motion and sampling";
constexpr const char* kOdometry = "Pedestrian odometry";
constexpr const char* kSearch = "Search";
constexpr const char* kGeneral = "General";

template <typename T>
CLI::Option* add(CLI::App& app, const char* group, const std::string& name, T& target,
                 const std::string& description) {
  return app.add_option(name, target, description)
      ->capture_default_str()
      ->group(group)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

bool is_toml_literal(const std::string& value) {
  if (value == "true" || value == "false") return true;
  double number = 0;
  return CLI::detail::lexical_cast(value, number);
}

}  // namespace

void add_frame_options(CLI::App& app, Settings& s) {
  add(app, kFrames, "--image-rate-hz", s.walk.frames.image_rate_hz,
      "frames per second of a folder of images, which carries no times")
      ->check(CLI::PositiveNumber);
  add(app, kFrames, "--thumbnail-width", s.walk.thumbnail.width, "pixels [SeqSLAM]")
      ->check(CLI::Range(8, 1024));
  add(app, kFrames, "--thumbnail-height", s.walk.thumbnail.height, "pixels [SeqSLAM]")
      ->check(CLI::Range(8, 1024));
  add(app, kFrames, "--preview-width-px", s.walk.preview_width_px,
      "pixels, width of the small picture kept of each keyframe; 0 keeps none")
      ->check(CLI::Range(0, 4096));
  add(app, kFrames, "--patch-px", s.patch.patch_px,
      "pixels, side of a normalised patch [SSS Eq. 2, OpenSeqSLAM]")
      ->check(CLI::Range(2, 1024));
  add_choice(app, kFrames, "--patch-shape", s.patch.shape,
             {{"grid", vo::PatchShape::kGrid}, {"window", vo::PatchShape::kWindow}},
             "patches of a fixed grid, or a window around each pixel");
  add(app, kFrames, "--patch-min-deviation", s.patch.min_deviation,
      "grey levels; a flatter patch counts as having this deviation")
      ->check(CLI::PositiveNumber);
  add(app, kFrames, "--patch-min-contrast", s.patch.min_contrast,
      "the same, as a share of the median deviation of the picture's patches")
      ->check(CLI::Range(0.0, 10.0));
}

void add_sampling_options(CLI::App& app, Settings& s) {
  add_choice(app, kSampling, "--motion", s.sampling.sampling.motion,
             {{"sad", vo::MotionSource::kSad},
              {"steps", vo::MotionSource::kSteps},
              {"hybrid", vo::MotionSource::kHybrid},
              {"vo", vo::MotionSource::kVisualOdometry},
              {"file", vo::MotionSource::kFile},
              {"none", vo::MotionSource::kNone}},
             "what walks are resampled by: alignment error [SSS 3.2], steps [PVO], both and visual odometry "
             "[SSS 3.5], visual odometry alone, the trajectory of --motion-file, or nothing");
  add(app, kSampling, "--motion-file", s.motion_file,
      "trajectory for --motion file: TUM, KITTI, or CSV with time_s,x_m,y_m; metres")
      ->check(CLI::ExistingFile);
  add(app, kSampling, "--motion-file-start-s", s.external.start_s,
      "seconds that the trajectory's clock shows at the first frame");
  add(app, kSampling, "--motion-file-tolerance-s", s.external.time_tolerance_s,
      "seconds that a lone pose may be away from its frame")
      ->check(CLI::NonNegativeNumber);
  add(app, kSampling, "--motion-file-gap-s", s.external.max_gap_s,
      "seconds between poses beyond which the trajectory is lost; alignment error takes its place")
      ->check(CLI::NonNegativeNumber);
  add(app, kSampling, "--every", s.sampling.sampling.every, "frames between keyframes, with --motion none")
      ->check(CLI::Range(1, 1000000));
  add(app, kSampling, "--sampling-n", s.sampling.sampling.n,
      "n of SSS Eq. 4, larger for fewer keyframes; motion in metres has 0.85 m between them if this is not "
      "given")
      ->check(CLI::Range(0.01, 1000.0));
  add(app, kSampling, "--spacing-m", s.sampling.sampling.spacing_m,
      "metres between keyframes, instead of SSS Eq. 4; with motion in metres (hybrid, steps)")
      ->check(CLI::PositiveNumber);
  add(app, kSampling, "--separations", s.sampling.motion.visual.model.separations,
      "frame separations compared for each frame's motion, 1 is SSS Eq. 3 to the letter")
      ->check(CLI::Range(1, 10));
  add(app, kSampling, "--max-speed", s.sampling.motion.visual.model.max_speed,
      "times the walk's mean speed; what seems faster is a turn or a jolt")
      ->check(CLI::PositiveNumber);
  add(app, kSampling, "--standing-span-s", s.sampling.motion.visual.standing.span_s,
      "seconds after which an unchanged view means standing still; 0 never does")
      ->check(CLI::NonNegativeNumber);
  add(app, kSampling, "--local-window-s", s.sampling.motion.visual.model.local_window_s,
      "seconds, learn motion from the last so many only [SSS 3]; 0 for the whole walk")
      ->check(CLI::NonNegativeNumber);
  add(app, kSampling, "--high-error-mads", s.sampling.motion.visual.alignment.high_error_mads,
      "median absolute deviations above which a window is left out of learning [SSS 6]")
      ->check(CLI::NonNegativeNumber);
  add(app, kSampling, "--smoothing-s", s.sampling.motion.visual.alignment.smoothing_s,
      "seconds, window over which the error is smoothed for that [SSS Fig. 10]")
      ->check(CLI::NonNegativeNumber);
  add(app, kSampling, "--tie-scale", s.sampling.tie_scale,
      "true: bring each walk to the keyframe spacing of the route's first traverse")
      ->default_str(s.sampling.tie_scale ? "true" : "false");
}

void add_odometry_options(CLI::App& app, Settings& s) {
  vo::FeatureTrackerOptions& tracker = s.walk.tracker;
  vo::PedestrianMotionOptions& pedestrian = s.sampling.motion.pedestrian;
  add(app, kOdometry, "--fov-deg", tracker.fov_deg,
      "degrees, horizontal field of view of the camera [PVO 5.3]")
      ->check(CLI::Range(10.0, 170.0));
  add(app, kOdometry, "--camera", s.camera, "calibration file of OpenCV (YAML), instead of --fov-deg");
  add(app, kOdometry, "--step-length", pedestrian.step_length.length_m, "metres, of an average step")
      ->check(CLI::PositiveNumber);
  add(app, kOdometry, "--camera-height-m", s.sampling.motion.hybrid.scale.camera_height_m,
      "metres above the ground, known of a vehicle's camera: gives hybrid motion its metres without steps")
      ->check(CLI::PositiveNumber);
  add_choice(app, kOdometry, "--step-length-model", pedestrian.step_length.model,
             {{"cadence", vo::StepLengthModel::kCadence}, {"fixed", vo::StepLengthModel::kFixed}},
             "in proportion to cadence about --step-length, or every step alike [PVO 5.3]");
  add(app, kOdometry, "--tracking-width-px", tracker.width_px,
      "pixels, wider frames are resized to it [PVO 5.1]")
      ->check(CLI::Range(64, 8192));
  add(app, kOdometry, "--surf-threshold", tracker.surf.detector.threshold,
      "least response of an interest point; small, as --surf-points limits them")
      ->check(CLI::PositiveNumber);
  add(app, kOdometry, "--surf-points", tracker.surf.detector.max_points,
      "interest points of a frame, the strongest")
      ->check(CLI::Range(10, 100000));
  add(app, kOdometry, "--tracking-window", tracker.window,
      "frames between which a point is compared [PVO Table 1]")
      ->check(CLI::Range(1, vo::TrackingWindow::kMaxWindow));
  add_choice(app, kOdometry, "--average", tracker.motion.average,
             {{"median", vo::Average::kMedian}, {"mean", vo::Average::kMean}},
             "of a frame's points [PVO 4.3]");
  add_choice(app, kOdometry, "--heading", tracker.motion.heading.method,
             {{"epipolar", vo::HeadingMethod::kEpipolar},
              {"regions", vo::HeadingMethod::kRegions},
              {"naive", vo::HeadingMethod::kNaive}},
             "rotation of the essential matrix, or the x shift by regions or of all points [PVO 4.5]");
  add(app, kOdometry, "--lowpass-order", pedestrian.signal.lowpass.order, "order of the Butterworth filter")
      ->check(CLI::Range(1, 8));
  add(app, kOdometry, "--lowpass-cutoff-hz", pedestrian.signal.lowpass.cutoff_hz, "its cut-off [PVO 5.3]")
      ->check(CLI::PositiveNumber);
  using vo::StepSignal;
  add_choice(
      app, kOdometry, "--step-signal", pedestrian.steps.signal,
      {{"auto", std::nullopt},
       {"bounce", StepSignal::kBounce},
       {"orientation", StepSignal::kOrientation},
       {"shift", StepSignal::kShift}},
      "what steps are read from: the picture's bounce, orientation alone [PVO 4.4], or x shift; auto: the "
      "bounce, unless another is like gait for longer");
  add(app, kOdometry, "--min-step-deg", pedestrian.steps.detection.delta_min_deg,
      "degrees of orientation change a frame, the static threshold; learned from the walk if not given [PVO "
      "4.4]")
      ->check(CLI::PositiveNumber);
}

void add_search_options(CLI::App& app, Settings& s) {
  add_choice(app, kSearch, "--candidates", s.localiser.candidate_use,
             {{"auto", place::CandidateUse::kAuto},
              {"never", place::CandidateUse::kNever},
              {"always", place::CandidateUse::kAlways}},
             "compare with a shortlist of the reference only; auto does so from 400 on 100000 keyframes up");
  add(app, kSearch, "--max-shift-px", s.localiser.cost.max_shift_px,
      "pixels of the thumbnail, sideways, within which the query is moved to fit best")
      ->check(CLI::Range(0, 100));
  add_choice(app, kSearch, "--enhance", s.localiser.enhancement.method,
             {{"standardise", place::Enhancement::kStandardise},
              {"local", place::Enhancement::kLocal},
              {"none", place::Enhancement::kNone}},
             "contrast enhancement of the cost matrix");
  add(app, kSearch, "--enhance-window", s.localiser.enhancement.window,
      "keyframes, with --enhance local [SeqSLAM's R]")
      ->check(CLI::Range(2, 1000000));
  add(app, kSearch, "--sequence-length", s.localiser.search.length, "keyframes on a line [SeqSLAM's d_s]")
      ->check(CLI::Range(1, 100000));
  add(app, kSearch, "--sequence-length-m", s.localiser.sequence_length_m,
      "metres on a line, instead of keyframes; needs a route with surveyed distances")
      ->check(CLI::PositiveNumber);
  add(app, kSearch, "--search-range-rad", s.localiser.search.search_range_rad,
      "radians either side of pi/4, slopes searched [SSS 5.1]")
      ->check(CLI::Range(0.0, 0.78));
  add(app, kSearch, "--slopes", s.localiser.search.slopes,
      "slopes across the range, before equal lines are merged")
      ->check(CLI::Range(1, 10001));
  add(app, kSearch, "--v-min", s.localiser.search.v_min,
      "reference keyframes per query keyframe, instead of the range [OpenSeqSLAM]")
      ->check(CLI::PositiveNumber);
  add(app, kSearch, "--v-max", s.localiser.search.v_max, "see --v-min")->check(CLI::PositiveNumber);
  add(app, kSearch, "--min-fraction", s.localiser.search.min_fraction,
      "share of a line that must lie inside the matrix, at the ends of a walk")
      ->check(CLI::Range(0.01, 1.0));
  add(app, kSearch, "--uniqueness-window", s.localiser.search.uniqueness_window,
      "reference keyframes around a match that do not compete with it [SeqSLAM's Rwindow]")
      ->check(CLI::Range(0, 1000000));
  add(app, kSearch, "--accept-score", s.localiser.acceptance_threshold, "least score of an accepted match");
  add(app, kSearch, "--correct-drift", s.correct_drift,
      "true: follow the walk's steps too and correct their drift by the matches, where the route has poses")
      ->default_str(s.correct_drift ? "true" : "false");
  add_choice(app, kSearch, "--compat", s.compatibility,
             {{"none", Compatibility::kNone},
              {"openseqslam", Compatibility::kOpenSeqSlam},
              {"openseqslam-mended", Compatibility::kOpenSeqSlamMended}},
             "run the search of the original OpenSeqSLAM, as it was or with constant patches made neutral");
}

void add_general_options(CLI::App& app, Settings& s) {
  add(app, kGeneral, "--threads", s.threads, "threads, 0 for one per core; results do not depend on it")
      ->check(CLI::Range(0, 1024));
}

void add_all_options(CLI::App& app, Settings& settings) {
  add_frame_options(app, settings);
  add_sampling_options(app, settings);
  add_odometry_options(app, settings);
  add_search_options(app, settings);
  add_general_options(app, settings);
}

std::vector<SettingEntry> entries(const Settings& settings) {
  Settings copy = settings;
  CLI::App app;
  add_all_options(app, copy);
  std::vector<SettingEntry> all;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_lnames().empty() || option->get_lnames().front() == "help") continue;
    std::string value = option->get_default_str();
    if (!value.empty() && !is_toml_literal(value)) value = fmt::format("\"{}\"", value);
    all.push_back({option->get_group(), option->get_lnames().front(), value, option->get_description()});
  }
  return all;
}

std::string to_toml(const Settings& settings) {
  std::string text = "# Settings of retrace, for --config; flags on the command line come first.\n";
  std::string group;
  for (const SettingEntry& entry : entries(settings)) {
    if (entry.group != group) text += fmt::format("\n# ---- {} ----\n", entry.group);
    group = entry.group;
    text += fmt::format("\n# {}\n", entry.description);
    text += entry.value.empty() ? fmt::format("# {} =\n", entry.name)
                                : fmt::format("{} = {}\n", entry.name, entry.value);
  }
  return text;
}

bool given(const CLI::App& app, const std::string& option) {
  const CLI::Option* found = app.get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

void follow_motion(Settings& settings) {
  vo::keep_for(settings.sampling.sampling.motion, settings.walk);
}

vo::Walk read_walk(const std::string& source, const Settings& settings,
                   const vo::ProgressCallback& progress) {
  const bool by_file = settings.sampling.sampling.motion == vo::MotionSource::kFile;
  if (by_file == settings.motion_file.empty()) {
    throw vo::Error("--motion-file", by_file ? "is missing" : "has no meaning without --motion file",
                    "--motion file --motion-file TRAJECTORY");
  }
  vo::Walk walk = vo::read_walk(source, settings.walk, progress);
  if (by_file) {
    walk.track =
        vo::external_trajectory(vo::read_pose_series(settings.motion_file), walk.time_s, settings.external);
  }
  return walk;
}

void resolve(const CLI::App& app, Settings& settings) {
  place::SequenceSearchOptions& search = settings.localiser.search;
  if (settings.compatibility != Compatibility::kNone) {
    place::openseqslam::Options original;
    original.patch_px = settings.patch.patch_px;
    original.enhancement_window = settings.localiser.enhancement.window;
    original.match_window = search.uniqueness_window;
    original.v_min = search.v_min.value_or(original.v_min);
    original.v_max = search.v_max.value_or(original.v_max);
    original.quirks = place::openseqslam::Quirks::original();
    if (settings.compatibility == Compatibility::kOpenSeqSlamMended)
      original.quirks.constant_patch_is_zero = false;
    if (original.v_min > original.v_max) throw vo::Error("--v-min", "is above --v-max", "v-min <= v-max");
    settings.localiser.openseqslam = original;
    // Its score is 1 - best / second best; another scale than ours, so another threshold.
    if (!given(app, "--accept-score")) settings.localiser.acceptance_threshold = 0.1;
  } else if (std::string reason; !search.is_valid(&reason)) {
    throw vo::Error("search settings", reason);
  }
  const place::Sampling& sampling = settings.sampling.sampling;
  if (sampling.motion != vo::MotionSource::kNone && sampling.every != 1) {
    throw vo::Error("--every", fmt::format("has no meaning with --motion {}", name_of(sampling.motion)),
                    "--motion none --every K");
  }
  if (given(app, "--sampling-n")) settings.sampling.sampling.usual_spacing_m = 0;
  const bool may_be_metric = sampling.motion == vo::MotionSource::kSteps ||
                             sampling.motion == vo::MotionSource::kHybrid ||
                             sampling.motion == vo::MotionSource::kFile;
  if (sampling.spacing_m && !may_be_metric) {
    throw vo::Error("--spacing-m", fmt::format("has no meaning with --motion {}", name_of(sampling.motion)),
                    "motion in metres: --motion hybrid or steps");
  }
  if (2 * settings.localiser.cost.max_shift_px >= settings.walk.thumbnail.width) {
    throw vo::Error("--max-shift-px", fmt::format("is {}", settings.localiser.cost.max_shift_px),
                    "less than half of --thumbnail-width");
  }
  follow_motion(settings);
  if (!settings.camera.empty()) settings.walk.tracker.camera = vo::read_camera_calibration(settings.camera);
  settings.walk.vo.fov_deg = settings.walk.tracker.fov_deg;
  settings.walk.vo.camera = settings.walk.tracker.camera;
}

}  // namespace retrace
