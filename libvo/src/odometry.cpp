#include "vo/odometry.hpp"

#include "vo/base/error.hpp"
#include "vo/base/median.hpp"
#include "vo/base/parallel.hpp"
#include "vo/base/stopping.hpp"
#include "vo/gait/playback.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

std::vector<std::uint8_t> preview_of(const Frame& frame, int width_px) {
  const cv::Mat& image = frame.colour.empty() ? frame.image : frame.colour;
  const int width = std::min(width_px, image.cols);
  const int height = std::max(1, static_cast<int>(std::int64_t{image.rows} * width / image.cols));
  // Halving is many times faster than any other ratio, and looks as good.
  cv::Mat small = image;
  while (small.cols >= 2 * width && small.cols % 2 == 0 && small.rows % 2 == 0) {
    cv::resize(small, small, {small.cols / 2, small.rows / 2}, 0, 0, cv::INTER_AREA);
  }
  if (small.cols != width) cv::resize(small, small, {width, height}, 0, 0, cv::INTER_AREA);
  std::vector<std::uint8_t> jpeg;
  constexpr int kQuality = 75;
  cv::imencode(".jpg", small, jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return jpeg;
}

/// The next frames, at most `count`; none at the end.
std::vector<Frame> read_batch(FrameSource& frames, std::size_t count) {
  std::vector<Frame> batch;
  while (batch.size() < count) {
    std::optional<Frame> frame = frames.next();
    if (!frame) break;
    batch.push_back(std::move(*frame));
  }
  return batch;
}

/// The trackers that follow a walk from frame to frame.
struct Trackers {
  FeatureTracker features;
  MonocularVo visual_odometry;
};

/// The data kept of a batch of frames, computed in parallel.
void keep(const std::vector<Frame>& batch, const WalkOptions& options, Trackers& trackers, Walk& walk) {
  const std::size_t begin = walk.frames();
  walk.thumbnails.pixels.resize((begin + batch.size()) * walk.thumbnails.image_size());
  if (options.preview_width_px > 0) walk.previews.resize(begin + batch.size());
  for (const Frame& frame : batch) walk.time_s.push_back(frame.time_s);
  walk.frame_width_px = batch.front().image.cols;
  walk.frame_height_px = batch.front().image.rows;
  walk.records.resize(options.recorders.size());
  for (auto& records : walk.records) records.resize(begin + batch.size());
  parallel_for(batch.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < options.recorders.size(); ++k)
      walk.records[k][begin + i] = options.recorders[k](batch[i]);
    make_thumbnail(batch[i].image, options.thumbnail, walk.thumbnails[begin + i]);
    if (options.preview_width_px > 0)
      walk.previews[begin + i] = preview_of(batch[i], options.preview_width_px);
  });
  std::vector<cv::Mat> images;
  for (const Frame& frame : batch) images.push_back(frame.image);
  parallel_invoke(
      [&] {
        if (!options.visual_odometry) return;
        for (const Frame& frame : batch) {
          stop_if_asked();
          trackers.visual_odometry.push(frame.image, frame.time_s);
        }
      },
      [&] {
        if (!options.track_features) return;
        std::ranges::move(trackers.features.push(images), std::back_inserter(walk.tracked));
      });
}

/// Warnings about jumps of the clock: each one that interrupts the walk, and the others together.
std::vector<std::string> gap_warnings(const Walk& walk) {
  std::vector<std::string> warnings;
  std::vector<ClockGap> filled;
  for (const ClockGap& gap : walk.gaps) {
    if (!parts_walk(gap)) {
      filled.push_back(gap);
      continue;
    }
    warnings.push_back(fmt::format(
        "{}: no frames for {:.1f} s, from {:.2f} s on (frame {}); what was walked in it is not known, and no "
        "sequence crosses it",
        walk.source, gap.length_s, walk.time_s[gap.frame - 1], gap.frame - 1));
  }
  if (!filled.empty()) {
    const ClockGap& first = filled.front();
    warnings.push_back(fmt::format(
        "{}: no frames for {:.1f} s, from {:.2f} s on (frame {}){}; what was walked in it is taken from the "
        "pace around it",
        walk.source, first.length_s, walk.time_s[first.frame - 1], first.frame - 1,
        filled.size() > 1 ? fmt::format(", and {} jumps of the clock more like it", filled.size() - 1)
                          : std::string()));
  }
  return warnings;
}

}  // namespace

Walk read_walk(const std::string& source, const WalkOptions& options, const ProgressCallback& progress) {
  return read_walk(std::span(&source, 1), options, progress);
}

Walk read_walk(std::span<const std::string> sources, const WalkOptions& options,
               const ProgressCallback& progress) {
  FrameSourceOptions frames = options.frames;
  frames.colour_width_px = std::max({0, options.preview_width_px, options.colour_width_px});
  const auto source = open_frame_source(sources, frames);
  const std::string name =
      sources.size() == 1 ? sources[0] : fmt::format("{} and {} more", sources[0], sources.size() - 1);
  return read_walk(*source, name, options, progress);
}

Walk read_walk(FrameSource& frames, const std::string& name, const WalkOptions& options,
               const ProgressCallback& progress) {
  if (options.preview_width_px < 0) throw std::invalid_argument("read_walk: preview_width_px must be >= 0");
  const std::string stage = fmt::format("reading {}", name);
  Walk walk;
  walk.source = name;
  Trackers trackers{FeatureTracker(options.tracker), MonocularVo(options.vo)};
  walk.thumbnails = make_image_stack(options.thumbnail.width, options.thumbnail.height, 0);

  // Each batch is processed while the next is decoded: a few frames for each thread, enough to share the
  // work, few enough for 4K video.
  const std::size_t batch_size = 4 * static_cast<std::size_t>(thread_count());
  keep_threads([&] {
    std::vector<Frame> batch = read_batch(frames, batch_size);
    while (!batch.empty()) {
      std::vector<Frame> next;
      parallel_invoke([&] { next = read_batch(frames, batch_size); },
                      [&] { keep(batch, options, trackers, walk); });
      batch = std::move(next);
      if (progress && !progress({.stage = stage,
                                 .done = static_cast<std::int64_t>(walk.frames()),
                                 .total = frames.expected_frames()})) {
        break;
      }
    }
  });
  if (walk.frames() < 2) {
    throw Error(name, fmt::format("has {} frame", walk.frames()), "a walk of at least 2 frames");
  }
  walk.start_utc_s = frames.start_utc_s();
  walk.warnings = frames.warnings();
  walk.gaps = clock_gaps(walk.time_s);
  for (std::string& warning : gap_warnings(walk)) walk.warnings.push_back(std::move(warning));
  if (options.visual_odometry) {
    walk.track = trackers.visual_odometry.finish();
    for (const ClockGap& gap : walk.gaps) {  // the view after it may be anywhere
      walk.track->frames[gap.frame].valid = false;
      walk.track->frames[gap.frame].loss = TrackLoss::kGap;
    }
  }
  return walk;
}

namespace {

/// False for frames with hardly any contrast, and those compared with one.
std::vector<bool> with_contrast(const Walk& walk, const VisualMotionOptions& options) {
  const std::vector<double> contrast = patch_contrast(walk.thumbnails, options.patch.patch_px);
  const double least = options.min_contrast * median(contrast);
  std::vector<bool> seen(contrast.size());
  for (std::size_t i = 0; i < seen.size(); ++i)
    seen[i] = contrast[i] >= least && (i == 0 || contrast[i - 1] >= least);
  return seen;
}

}  // namespace

VisualMotion visual_motion(const Walk& walk, const VisualMotionOptions& options) {
  std::optional<VisualMotion> motion = visual_motion_if_any(walk, options);
  if (!motion)
    throw Error(walk.source, "shows no motion to learn from", "a walk along which the scene changes");
  return std::move(*motion);
}

std::optional<VisualMotion> visual_motion_if_any(const Walk& walk, const VisualMotionOptions& options) {
  const ImageStack normalised = patch_normalise(walk.thumbnails, options.patch);  // SSS Eq. 2
  const Pauses pauses = find_pauses(normalised, walk.time_s, options.standing);
  if (pauses.still) return std::nullopt;
  VisualMotion motion{.standing = pauses.standing};
  motion.errors = alignment_errors(normalised, walk.time_s, options.alignment);  // Eq. 1
  std::vector<bool> excluded =
      high_error_windows(motion.errors, walk.time_s, motion.standing, options.alignment);  // Fig. 10
  motion.usable = with_contrast(walk, options);
  for (std::size_t i = 0; i < excluded.size(); ++i) {
    motion.usable[i] = motion.usable[i] && !excluded[i];
    excluded[i] = excluded[i] || motion.standing[i];
  }
  motion.model = learn_motion_model(mean_errors(motion.errors, excluded));                     // Fig. 2, 3
  motion.displacement = estimate_motion(motion.errors, excluded, walk.time_s, options.model);  // Eq. 3
  for (std::size_t i = 0; i < motion.displacement.size(); ++i)
    if (motion.standing[i]) motion.displacement[i] = 0;
  fill_gaps_by_pace(walk.time_s, walk.gaps, motion.displacement);
  for (const ClockGap& gap : walk.gaps) motion.usable[gap.frame] = false;
  if (std::ranges::none_of(motion.displacement, [](double d) { return d > 0; })) return std::nullopt;
  return motion;
}

namespace {

/// Moves steps found at even times to the frames of the walk. `clock_s`: of its frames, `without_long_gaps`.
StepDetection at_frames(StepDetection even, const GaitSignal& signal, const Walk& walk,
                        std::span<const double> clock_s) {
  const double half_s = 0.5 / signal.rate_hz;
  const auto gap_at = [&](std::size_t frame) {
    return std::ranges::lower_bound(walk.gaps, frame, {}, &ClockGap::frame);
  };
  std::vector<Step> steps;
  for (Step step : even.steps) {
    auto after = static_cast<std::size_t>(std::ranges::lower_bound(clock_s, step.time_s) - clock_s.begin());
    after = std::clamp<std::size_t>(after, 1, clock_s.size() - 1);
    const double since_s = step.time_s - clock_s[after - 1], until_s = clock_s[after] - step.time_s;
    const auto gap = gap_at(after);
    const bool in_gap = gap != walk.gaps.end() && gap->frame == after && since_s > half_s && until_s > half_s;
    if (in_gap && parts_walk(*gap)) continue;
    step.frame = in_gap || until_s <= since_s || after == 1 ? after : after - 1;
    step.time_s = in_gap ? walk.time_s[after - 1] + since_s : walk.time_s[step.frame];
    steps.push_back(step);
  }
  even.steps = std::move(steps);
  even.bridged = static_cast<std::size_t>(std::ranges::count(even.steps, true, &Step::bridged));
  even.delta_dyn = read_at(even.delta_dyn, signal.time_s, clock_s);
  return even;
}

/// Everything that follows from the steps.
void walk_steps(PedestrianMotion& motion, const PedestrianMotionOptions& options) {
  const auto& [steps, bridged, partial, delta_min, gait_share, delta_dyn] = motion.detection;
  const std::vector<double>& time_s = motion.signal.time_s;
  motion.step_length_m = step_lengths_m(steps, options.step_length);  // PVO 5.3 (4)
  motion.displacement_m =
      step_displacement_m(steps, motion.step_length_m, time_s, partial, options.dead_reckoning);
  motion.trajectory = dead_reckon(steps, motion.step_length_m, motion.signal.heading_rad, time_s, partial,
                                  options.dead_reckoning);  // 4.6
  motion.activity = detect_activity(motion.signal, steps, partial, options.activity);
}

}  // namespace

PedestrianMotion pedestrian_motion(const Walk& walk, const PedestrianMotionOptions& options) {
  if (walk.tracked.size() != walk.frames()) {
    throw std::invalid_argument("pedestrian_motion: a walk read with track_features expected");
  }
  const std::vector<double> clock_s = without_long_gaps(walk.time_s);
  if (const double rate_hz = frame_rate_hz(walk.time_s); rate_hz <= 2 * options.signal.lowpass.cutoff_hz) {
    std::string problem = fmt::format("has {:.3g} frames/s, too few to see steps", rate_hz);
    const auto cadence_hz = impossible_cadence_hz(walk.tracked, clock_s, options.signal, options.steps);
    if (cadence_hz) problem += ", and " + impossible_cadence_text(*cadence_hz);
    throw Error(
        walk.source, problem,
        fmt::format("more than {:.3g}, twice the fastest steps", 2 * options.signal.lowpass.cutoff_hz));
  }
  const EvenMotion even = even_motion(walk.tracked, clock_s);
  const GaitSignal signal = gait_signal(even.motion, even.time_s, options.signal);  // PVO 4.3, 4.5
  StepReading reading = read_steps(signal, options.steps);                          // 4.4

  PedestrianMotion motion;
  motion.signal = signal_at_frames(signal, walk.tracked, clock_s);
  motion.signal.time_s = walk.time_s;
  motion.step_signal = reading.signal;
  motion.detection = at_frames(std::move(reading.detection), signal, walk, clock_s);
  walk_steps(motion, options);
  return motion;
}

PedestrianMotion without_steps(PedestrianMotion motion, const PedestrianMotionOptions& options) {
  motion.detection.steps.clear();
  motion.detection.bridged = 0;
  motion.detection.partial = {};
  motion.detection.gait_share = 0;
  walk_steps(motion, options);
  return motion;
}

std::optional<double> calibrated_step_length_m(const Walk& walk, double length_m,
                                               const PedestrianMotionOptions& options) {
  const double steps = steps_made(pedestrian_motion(walk, options).detection);
  if (steps == 0) return std::nullopt;
  return calibrated_step_length_m(length_m, steps);
}

}  // namespace vo
