#include "place/stage_options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/camera_calibration.hpp>
#include <vo/tracks/view_points.hpp>

namespace place {
namespace {

template <typename Value, typename Target>
void put(const std::optional<Value>& value, Target& target) {
  if (value) target = static_cast<Target>(*value);
}

void put(const std::optional<double>& value, std::optional<double>& target) {
  if (value) target = value;
}

/// The enumerator for a choice in the table.
template <typename Target>
void put_choice(const std::optional<std::string>& value, Target& target,
                std::initializer_list<std::pair<std::string_view, Target>> choices) {
  if (!value) return;
  for (const auto& [name, choice] : choices) {
    if (*value == name) {
      target = choice;
      return;
    }
  }
  throw std::invalid_argument("stage_options: resolved settings expected");
}

/// Numbers separated by a character, as many as in `target`.
template <typename Number, std::size_t count>
void put_numbers(std::string_view name, const std::optional<std::string>& text, char between,
                 std::array<Number, count>& target) {
  if (!text) return;
  const char* at = text->data();
  const char* const end = at + text->size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [after, error] = std::from_chars(at, end, target[i]);
    const bool followed = i + 1 < count ? after != end && *after == between : after == end;
    if (error != std::errc() || !followed) {
      throw vo::Error(name, fmt::format("is '{}'", *text),
                      fmt::format("{} numbers with '{}' between them", count, between));
    }
    at = after + 1;
  }
}

void put_crop(const std::optional<std::string>& text, std::optional<cv::Rect>& target) {
  if (!text) return;
  std::array<int, 4> side{};
  put_numbers("crop", text, ',', side);
  const auto [x, y, width, height] = side;
  if (x < 0 || y < 0 || width < 1 || height < 1)
    throw vo::Error("crop", fmt::format("is '{}'", *text),
                    "x,y,width,height in pixels, of an upright picture's top left corner on");
  target = cv::Rect(x, y, width, height);
}

void put_axes(const std::optional<std::string>& value, vo::TrajectoryAxes& target) {
  put_choice(value, target,
             {{"auto", vo::TrajectoryAxes::kAuto},
              {"vehicle", vo::TrajectoryAxes::kVehicle},
              {"camera", vo::TrajectoryAxes::kCamera}});
}

void put_reading(const Settings& s, StageOptions& options) {
  vo::WalkOptions& walk = options.walk;
  put(s.frame_rate_hz, walk.frames.frame_rate_hz);
  put(s.exif_times, walk.frames.exif_times);
  put_crop(s.crop, walk.frames.crop);
  put(s.mask, walk.frames.mask);
  put(s.thumbnail_width, walk.thumbnail.width);
  put(s.thumbnail_height, walk.thumbnail.height);
  put(s.preview_width_px, walk.preview_width_px);
  vo::PatchNormalisationOptions& patch = options.matching.patch;
  put(s.patch_px, patch.patch_px);
  put_choice(s.patch_shape, patch.shape,
             {{"grid", vo::PatchShape::kGrid}, {"window", vo::PatchShape::kWindow}});
  put(s.patch_min_contrast, patch.min_contrast);
  options.sampling.motion.visual.patch = patch;
}

void put_describing(const Settings& s, StageOptions& options) {
  if (!s.descriptor) return;
  DescriptorOptions describe{.name = *s.descriptor, .patch = options.matching.patch};
  put(s.descriptor_file, describe.file.path);
  put_choice(s.descriptor_metric, describe.file.metric,
             {{"cosine", Metric::kCosine}, {"l1", Metric::kL1}, {"l2", Metric::kL2}});
  NetworkOptions& network = describe.network;
  put(s.model, network.model);
  put(s.model_config, network.model_config);
  put(s.layer, network.layer);
  std::array pool{network.pool_rows, network.pool_columns};
  std::array input{network.input_width, network.input_height};
  put_numbers("pool", s.pool, 'x', pool);
  put_numbers("input", s.input, 'x', input);
  for (const int side : {pool[0], pool[1], input[0], input[1]})
    if (side < 1 || side > 8192)
      throw vo::Error("pool, input", fmt::format("has a side of {}", side), "1 to 8192");
  network.pool_rows = pool[0];
  network.pool_columns = pool[1];
  network.input_width = input[0];
  network.input_height = input[1];
  put(s.scale, network.scale);
  put_numbers("mean", s.mean, ',', network.mean);
  put(s.swap_rb, network.swap_rb);

  const std::shared_ptr<const DescriptorSet> descriptors = make_descriptors(describe);
  options.sampling.descriptors = options.matching.descriptors = descriptors;
  const bool records = std::ranges::any_of(
      *descriptors, [](const auto& descriptor) { return descriptor->traits().records_frames; });
  for (std::size_t i = 0; records && i < descriptors->size(); ++i) {
    options.walk.recorders.push_back(
        [descriptors, i](const vo::Frame& frame) { return (*descriptors)[i]->record(frame); });
    options.walk.colour_width_px =
        std::max(options.walk.colour_width_px, (*descriptors)[i]->traits().colour_width_px);
  }
}

void put_motion(const Settings& s, StageOptions& options) {
  WalkSamplingOptions& sampling = options.sampling;
  put_choice(s.motion, sampling.source,
             {{"none", vo::MotionSource::kNone},
              {"sad", vo::MotionSource::kSad},
              {"steps", vo::MotionSource::kSteps},
              {"auto", vo::MotionSource::kSteps},  // keeps what `choose_motion` needs
              {"hybrid", vo::MotionSource::kHybrid},
              {"vo", vo::MotionSource::kVisualOdometry},
              {"vo-sad", vo::MotionSource::kHybridAsPublished},
              {"file", vo::MotionSource::kFile}});
  put(s.motion_file, options.motion_file);
  put(s.motion_file_start_s, options.motion_file_fit.start_s);
  put(s.motion_file_gap_s, options.motion_file_fit.max_gap_s);
  options.motion_file_fit.metric = s.motion_file_unit != "none";
  put_axes(s.axes, options.motion_file_form.axes);
  put(s.every, sampling.every);
  sampling.n = s.sampling_n;
  sampling.spacing_m = s.spacing_m;
  put(s.tie_scale, sampling.tie_scale);
  vo::VisualMotionOptions& visual = sampling.motion.visual;
  put(s.separations, visual.model.separations);
  put(s.max_speed, visual.model.max_speed);
  put(s.standing_span_s, visual.standing.span_s);
  put(s.local_window_s, visual.model.local_window_s);
  put(s.high_error_mads, visual.alignment.high_error_mads);
}

void put_odometry(const Settings& s, StageOptions& options) {
  vo::FeatureTrackerOptions& tracker = options.walk.tracker;
  put(s.fov_deg, tracker.fov_deg);
  if (s.camera) tracker.camera = vo::read_camera_calibration(*s.camera);
  options.walk.vo.fov_deg = tracker.fov_deg;
  options.walk.vo.camera = tracker.camera;
  put(s.tracking_width_px, tracker.width_px);
  put(s.tracking_window, tracker.window);
  put_choice(s.average, tracker.motion.average,
             {{"median", vo::Average::kMedian}, {"mean", vo::Average::kMean}});
  put_choice(s.heading, tracker.motion.heading.method,
             {{"epipolar", vo::HeadingMethod::kEpipolar},
              {"regions", vo::HeadingMethod::kRegions},
              {"naive", vo::HeadingMethod::kNaive}});
  // PVO trusts the swing to cancel out over two steps.
  if (tracker.motion.heading.method == vo::HeadingMethod::kNaive)
    options.sampling.motion.pedestrian.signal.heading_cutoff_hz = 0;

  vo::PedestrianMotionOptions& pedestrian = options.sampling.motion.pedestrian;
  put(s.step_length, pedestrian.step_length.length_m);
  put_choice(s.step_length_model, pedestrian.step_length.model,
             {{"cadence", vo::StepLengthModel::kCadence}, {"fixed", vo::StepLengthModel::kFixed}});
  put(s.camera_height_m, options.sampling.motion.hybrid.scale.camera_height_m);
  put(s.lowpass_cutoff_hz, pedestrian.signal.lowpass.cutoff_hz);
  put_choice(s.step_signal, pedestrian.steps.signal,
             {{"auto", std::nullopt},
              {"bounce", vo::StepSignal::kBounce},
              {"orientation", vo::StepSignal::kOrientation},
              {"shift", vo::StepSignal::kShift},
              {"pvo", vo::StepSignal::kPublished}});
  pedestrian.dead_reckoning.as_published = pedestrian.steps.signal == vo::StepSignal::kPublished;
  put(s.min_step_deg, pedestrian.steps.detection.delta_min);
}

openseqslam::Options original_options(const Settings& s) {
  openseqslam::Options original;
  put(s.patch_px, original.patch_px);
  put(s.enhance_window, original.enhancement_window);
  put(s.uniqueness_window, original.match_window);
  put(s.v_min, original.v_min);
  put(s.v_max, original.v_max);
  original.quirks = openseqslam::Quirks::original();
  original.quirks.constant_patch_is_zero = s.compat == "openseqslam";
  return original;
}

/// Keeps the points of every frame, by the camera of `put_odometry`, after what descriptors keep.
void put_points(const Settings& s, StageOptions& options) {
  const bool asked = s.verify ? *s.verify > 0 : s.view_points.value_or(false);
  put(s.verify, options.verify);
  if (!asked) return;
  options.sampling.points_record = options.walk.recorders.size();
  const vo::ViewCamera camera{.fov_deg = options.walk.tracker.fov_deg,
                              .calibrated = options.walk.tracker.camera};
  options.walk.recorders.push_back(
      [camera](const vo::Frame& frame) { return vo::pack_view_points(frame.image, camera); });
}

void put_search(const Settings& s, StageOptions& options) {
  RouteMatchingOptions& matching = options.matching;
  put_choice(
      s.candidates, matching.candidate_use,
      {{"auto", CandidateUse::kAuto}, {"never", CandidateUse::kNever}, {"always", CandidateUse::kAlways}});
  if (s.max_shift_px) options.sampling.max_shift_px = matching.max_shift_px = s.max_shift_px;
  put(s.search, matching.method);
  put(s.fuse_traverses, matching.fuse_traverses);
  put_choice(s.enhance, matching.enhancement.method,
             {{"standardise", Enhancement::kStandardise},
              {"local", Enhancement::kLocal},
              {"none", Enhancement::kNone}});
  put(s.enhance_window, matching.enhancement.window);
  put(s.sequence_length, matching.search.length);
  put(s.sequence_length_m, matching.sequence_length_m);
  put(s.search_range_rad, matching.search.search_range_rad);
  put(s.v_min, matching.search.v_min);
  put(s.v_max, matching.search.v_max);
  put(s.min_fraction, matching.search.min_fraction);
  put(s.uniqueness_window, matching.search.uniqueness_window);
  put_choice(s.score, matching.search.score,
             {{"difference", MatchScore::kDifference}, {"ratio", MatchScore::kRatio}});
  matching.accept_score = s.accept_score;
  put(s.accept_probability, matching.accept_probability);
  if (s.compat && s.compat != "none") matching.openseqslam = original_options(s);
}

}  // namespace

SurveyOptions survey_options(const Settings& given) {
  SurveyOptions options;
  put(given.motion_file_gap_s, options.max_gap_s);
  put_axes(given.axes, options.axes);
  return options;
}

StageOptions stage_options(const Settings& resolved, bool follow_steps) {
  StageOptions options;
  put_reading(resolved, options);
  put_describing(resolved, options);
  put_motion(resolved, options);
  put_odometry(resolved, options);
  put_points(resolved, options);
  put_search(resolved, options);
  vo::keep_for(options.sampling.source, options.walk);
  if (follow_steps) options.walk.track_features = true;
  return options;
}

Settings settings_beside_survey(Settings given, bool by_trajectory, bool by_track,
                                const std::optional<std::string>& motion_of_route) {
  if ((given.motion ? given.motion : motion_of_route) == "file") return given;
  if (by_trajectory) given.axes.reset();
  if (by_trajectory || by_track) given.motion_file_gap_s.reset();
  return given;
}

}  // namespace place
