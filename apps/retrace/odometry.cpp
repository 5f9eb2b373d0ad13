#include "command.hpp"
#include "imu_steps.hpp"
#include "odometry_files.hpp"
#include "progress_bar.hpp"
#include "run_directory.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <place/resolve.hpp>
#include <place/stage_options.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

struct OdometryOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walk;
  std::string output;
  std::optional<double> walk_length_m;
  bool visual_odometry = false;
  bool close_loops = false;
  std::string imu;  ///< "video", or none
};

/// The step length with which the steps seen add up to the walk's known distance.
double measured_step_length_m(const OdometryOptions& options, const vo::Walk& walk,
                              const vo::PedestrianMotionOptions& pedestrian) {
  const double steps = vo::steps_made(vo::pedestrian_motion(walk, pedestrian).detection);
  if (steps == 0)
    throw vo::Error(walk.source, "shows no steps", "a walk of the length given with --walk-length-m");
  return vo::calibrated_step_length_m(*options.walk_length_m, steps);
}

void print(const OdometryOptions& options, const vo::Walk& walk, const vo::WalkMotion& walked,
           const place::Settings& settings, const place::ClosedLoops& loops, const WrittenOdometry& written,
           const std::optional<std::size_t>& imu_steps) {
  const auto row = [](std::string_view name, const std::string& value, const std::string& note) {
    fmt::print("  {:<10}{:>10}   {}\n", name, value, note);
  };
  const vo::PedestrianMotion& motion = *walked.pedestrian;
  fmt::print("{}\n", walk.source);
  row("steps", std::to_string(motion.detection.steps.size()),
      fmt::format("{} of them bridged", motion.detection.bridged));
  if (imu_steps) row("imu", std::to_string(*imu_steps), "steps by the camera's accelerometer");
  row("distance", fmt::format("{:.1f} {}", written.distance, written.unit),
      walked.metric ? fmt::format("steps of {:.3f} m", settings.step_length.value_or(0))
                    : "no steps, so no metres: see --camera-height-m");
  row("duration", fmt::format("{:.1f} s", walk.time_s.back()),
      fmt::format("{} frames, {} with too few points", walk.frames(), motion.signal.bridged));
  if (options.close_loops)
    row("loops", std::to_string(loops.loops),
        fmt::format("places seen before, {} of them believed", loops.believed));
  fmt::print("see {}\n", (std::filesystem::path(options.output) / "report.html").string());
}

void odometry(const OdometryOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  place::Settings settings = place::resolve(options.settings, {.purpose = place::Purpose::kOdometry});
  place::StageOptions stages = place::stage_options(settings, true);
  prepare_run_directory(options.output, kOdometryFiles, options.common.force);

  stages.walk.preview_width_px = 0;
  stages.walk.visual_odometry = stages.walk.visual_odometry || options.visual_odometry;
  vo::Walk walk;
  {
    ProgressBar bar(options.walk.front());
    walk = vo::read_walk(options.walk, stages.walk, bar.callback());
  }
  if (options.walk_length_m) {
    settings.step_length = measured_step_length_m(options, walk, stages.sampling.motion.pedestrian);
    stages = place::stage_options(settings, true);
  }
  const vo::WalkMotion walked = vo::motion_with_steps(walk, stages.sampling.source, stages.sampling.motion);
  for (const std::string& warning : walk.warnings) spdlog::warn("{}", warning);
  for (const std::string& warning : walked.warnings) spdlog::warn("{}", warning);
  std::optional<std::size_t> by_imu;
  if (!options.imu.empty()) by_imu = imu_steps(options.imu, walk);
  place::ClosedLoops loops;
  if (options.close_loops) loops = place::close_loops(walk, walked, {.patch = stages.matching.patch});
  const WrittenOdometry written = write_odometry(options.output, walk, walked, settings,
                                                 {.loops = options.close_loops ? &loops : nullptr,
                                                  .visual_odometry = options.visual_odometry,
                                                  .imu_steps = by_imu,
                                                  .visual = stages.sampling.motion.visual});
  if (options.common.json) {
    fmt::print("{}", written.summary);
  } else {
    print(options, walk, walked, settings, loops, written, by_imu);
  }
}

}  // namespace

std::function<void()> declare_odometry(Arguments& arguments) {
  auto options = std::make_shared<OdometryOptions>();
  arguments.positional("walk", options->walk, kWalkArgument);
  arguments.option("-o,--output", options->output, "folder for the results").required();
  Argument length = arguments.option(
      "--walk-length-m", options->walk_length_m,
      "metres, known length of this walk: measures the step length, for --step-length on others");
  length.positive();
  arguments.flag("--visual-odometry", options->visual_odometry,
                 "write visual_odometry.csv and .tum as well: the camera's path, and why it was lost");
  arguments.flag("--close-loops", options->close_loops,
                 "find where the walk comes back to its own path, and correct the trajectory's drift by it");
  arguments.option(
      "--imu", options->imu,
      "`video`: also count steps by the accelerometer track of a GoPro's video, as a check [none]");
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kMotion, kOdometry, kGeneral},
                     {"every", "spacing-m", "sampling-n", "tie-scale", "motion-file", "motion-file-start-s",
                      "motion-file-gap-s", "axes", "preview-width-px"});
  arguments.common(options->common);
  arguments.footer(
      "Motion is hybrid, by steps and visual odometry [SSS 3.5], unless it is steps, by these alone [PVO].\n"
      "Examples:\n"
      "  retrace odometry walk.mp4 -o out --step-length 0.72\n"
      "  retrace odometry twenty_metres.mp4 -o calibration --walk-length-m 20    (prints the step length)\n"
      "  retrace evaluate-odometry out --truth truth.csv");
  return [options] { odometry(*options); };
}

}  // namespace retrace
