#include "command.hpp"
#include "imu_steps.hpp"
#include "odometry_arguments.hpp"
#include "odometry_files.hpp"
#include "odometry_table.hpp"
#include "run_directory.hpp"
#include "walk_reading.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

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

void odometry(const OdometryOptions& options) {
  if (options.walk_length_m && options.settings.step_length)
    throw vo::Error("--step-length", "has no effect beside --walk-length-m, which measures it",
                    "one of both");
  vo::set_thread_count(options.settings.threads.value_or(0));
  place::Settings settings = place::resolve(options.settings, {.purpose = place::Purpose::kOdometry});
  place::StageOptions stages = place::stage_options(settings, true);
  prepare_run_directory(options.output, kOdometryFiles, options.common.force);

  stages.walk.preview_width_px = 0;
  stages.walk.visual_odometry = stages.walk.visual_odometry || options.visual_odometry;
  const vo::Walk walk = read_with_bar(options.walk, stages.walk);
  if (options.walk_length_m) {
    settings.step_length =
        vo::calibrated_step_length_m(walk, *options.walk_length_m, stages.sampling.motion.pedestrian);
    if (!settings.step_length)
      throw vo::Error(walk.source, "shows no steps", "a walk of the length given with --walk-length-m");
    stages = place::stage_options(settings, true);
  }
  const vo::WalkMotion walked = vo::motion_with_steps(walk, stages.sampling.source, stages.sampling.motion);
  log_warnings(walk.warnings);
  log_warnings(walked.warnings);
  OdometryExtras extras{.visual_odometry = options.visual_odometry, .visual = stages.sampling.motion.visual};
  if (!options.imu.empty()) extras.imu_steps = imu_steps(options.imu, walk);
  place::ClosedLoops loops;
  if (options.close_loops) {
    loops = place::close_loops(walk, walked, {.patch = stages.matching.patch});
    extras.loops = &loops;
  }
  const WrittenOdometry written = write_odometry(options.output, walk, walked, settings, extras);
  if (options.common.json) {
    fmt::print("{}", written.summary);
  } else {
    fmt::print("{}", odometry_table(walk, walked, settings.step_length.value_or(0), written, extras));
    fmt::print("see {}\n", (std::filesystem::path(options.output) / "report.html").string());
  }
}

}  // namespace

std::function<void()> declare_odometry(Arguments& arguments) {
  auto options = std::make_shared<OdometryOptions>();
  arguments.positional("walk", options->walk, kWalkArgument);
  arguments.option("-o,--output", options->output, "folder for the results").required();
  arguments
      .option("--walk-length-m", options->walk_length_m,
              "metres, known length of this walk: measures the step length, for --step-length on others")
      .positive();
  arguments.flag("--visual-odometry", options->visual_odometry,
                 "write visual_odometry.csv and .tum as well: the camera's path, and why it was lost");
  arguments.flag("--close-loops", options->close_loops,
                 "find where the walk comes back to its own path, and correct the trajectory's drift by it");
  arguments.option(
      "--imu", options->imu,
      "`video`: also count steps by the accelerometer track of a GoPro's video, as a check [none]");
  declare_odometry_settings(arguments, options->settings);
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
