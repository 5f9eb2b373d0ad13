#include "close_loops.hpp"
#include "command.hpp"
#include "progress_bar.hpp"
#include "run_directory.hpp"
#include "settings.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <place/version.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;

struct OdometryOptions {
  Settings settings;
  CommonOptions common;
  std::string walk;
  std::string output;
  std::optional<double> walk_length_m;
  bool close_loops = false;
};

std::string frames_csv(const vo::Walk& walk, const vo::PedestrianMotion& motion) {
  std::string csv =
      "frame,time_s,displacement,unit,source,orientation_deg,dx_px,matches,heading_deg,"
      "step_signal,step_threshold,reliable,x_m,y_m\n";
  const std::vector<double>& signal = vo::step_signal(motion);
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    const vo::FrameMotion& tracked = walk.tracked[i];
    const vo::Pose2& pose = motion.trajectory.at_frame[i].pose;
    const auto measured = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.6f}", *value) : std::string();
    };
    csv += fmt::format("{},{:.6f},{:.6f},m,steps,{},{},{},{:.6f},{:.6f},{:.6f},{},{:.6f},{:.6f}\n", i,
                       walk.time_s[i], motion.displacement_m[i], measured(tracked.orientation_deg),
                       measured(tracked.shift_px), tracked.matches, motion.signal.heading_rad[i] * kDegrees,
                       signal[i], motion.detection.delta_dyn_deg[i], motion.signal.reliable[i] ? 1 : 0,
                       pose.x_m, pose.y_m);
  }
  return csv;
}

std::string steps_csv(const vo::PedestrianMotion& motion) {
  std::string csv = "step,frame,time_s,leg,x_m,y_m,heading_deg,length_m,bridged\n";
  for (std::size_t i = 0; i < motion.detection.steps.size(); ++i) {
    const vo::Step& step = motion.detection.steps[i];
    const vo::Pose2& pose = motion.trajectory.at_step[i];
    csv += fmt::format("{},{},{:.6f},{},{:.6f},{:.6f},{:.6f},{:.6f},{}\n", i + 1, step.frame, step.time_s,
                       step.leg == vo::Leg::kLeft ? "left" : "right", pose.x_m, pose.y_m,
                       pose.heading_rad * kDegrees, motion.step_length_m[i], step.bridged ? 1 : 0);
  }
  return csv;
}

constexpr std::string_view name_of(vo::Activity activity) {
  switch (activity) {
    case vo::Activity::kStanding:
      return "standing";
    case vo::Activity::kWalking:
      return "walking";
    case vo::Activity::kRunning:
      return "running";
    case vo::Activity::kUnknown:
      break;
  }
  return "unknown";
}

std::string activity_csv(const vo::PedestrianMotion& motion) {
  std::string csv = "time_s,activity,amplitude_deg,step_hz\n";
  for (const vo::ActivitySecond& second : motion.activity) {
    csv += fmt::format("{:.3f},{},{:.6f},{:.4f}\n", second.time_s, name_of(second.activity),
                       second.amplitude_deg, second.step_hz);
  }
  return csv;
}

ordered_json summary(const vo::Walk& walk, const vo::PedestrianMotion& motion, double step_length_m) {
  const bool by_shift = motion.step_signal == vo::StepSignal::kShift;
  double distance_m = 0;
  for (const double moved_m : motion.displacement_m) distance_m += moved_m;
  ordered_json json{{"walk", walk.source},
                    {"frames", walk.frames()},
                    {"duration_s", walk.time_s.back()},
                    {"steps", motion.detection.steps.size()},
                    {"step_signal", by_shift ? "x shift" : "orientation"},
                    {"step_signal_unit", by_shift ? "px a frame" : "deg a frame"},
                    {"steps_bridged", motion.detection.bridged},
                    {"frames_bridged", motion.signal.bridged},
                    {"step_length_m", step_length_m},
                    {"distance_m", distance_m},
                    {"delta_min", nullptr},
                    {"warnings", walk.warnings},
                    {"version", place::kVersion}};
  for (const vo::Activity activity :
       {vo::Activity::kStanding, vo::Activity::kWalking, vo::Activity::kRunning, vo::Activity::kUnknown}) {
    json["activity_s"][std::string(name_of(activity))] =
        std::ranges::count(motion.activity, activity, &vo::ActivitySecond::activity);
  }
  if (motion.detection.delta_min_deg) json["delta_min"] = *motion.detection.delta_min_deg;
  return json;
}

void odometry(const CLI::App& app, OdometryOptions& options) {
  Settings& settings = options.settings;
  vo::set_thread_count(settings.threads);
  resolve(app, settings);
  const fs::path folder = options.output;
  prepare_run_directory(
      folder, {"frames.csv", "steps.csv", "activity.csv", "trajectory.tum", "summary.json", "config.toml"},
      options.common.force);

  settings.walk.preview_width_px = 0;
  settings.walk.track_features = true;
  vo::Walk walk;
  {
    ProgressBar bar;
    walk = vo::read_walk(options.walk, settings.walk, bar.callback());
  }
  for (const std::string& warning : walk.warnings) spdlog::warn("{}", warning);
  vo::PedestrianMotionOptions& pedestrian = settings.sampling.pedestrian;
  vo::PedestrianMotion motion = vo::pedestrian_motion(walk, pedestrian);
  if (options.walk_length_m) {
    if (motion.detection.steps.empty()) {
      throw vo::Error(options.walk, "shows no steps", "a walk of the length given with --walk-length-m");
    }
    pedestrian.step_length.length_m =
        vo::calibrated_step_length_m(*options.walk_length_m, motion.detection.steps.size());
    motion = vo::pedestrian_motion(walk, pedestrian);
  }

  ordered_json json = summary(walk, motion, pedestrian.step_length.length_m);
  vo::Trajectory trajectory = motion.trajectory.at_frame;
  if (options.close_loops) {
    ClosedLoops closed = close_loops(walk, motion, {.patch = settings.patch});
    json["loops"] = {{"keyframes", closed.loops}, {"believed", closed.believed}};
    trajectory = std::move(closed.trajectory);
    vo::write_file(folder / "trajectory_odometry.tum",
                   vo::to_tum(motion.trajectory.at_frame, "the same before loops were closed"));
  }
  vo::write_file(folder / "frames.csv", frames_csv(walk, motion));
  vo::write_file(folder / "steps.csv", steps_csv(motion));
  vo::write_file(folder / "activity.csv", activity_csv(motion));
  vo::write_file(folder / "trajectory.tum",
                 vo::to_tum(trajectory, "pose of each frame, metres and radians since the first"));
  vo::write_file(folder / "summary.json", json.dump(2) + "\n");
  vo::write_file(folder / "config.toml", to_toml(settings));
  if (options.common.json) {
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("{}: {} steps, {:.1f} m in {:.1f} s with steps of {:.3f} m; see {}\n", options.output,
             motion.detection.steps.size(), json["distance_m"].get<double>(), walk.time_s.back(),
             pedestrian.step_length.length_m, (folder / "steps.csv").string());
  if (options.close_loops) {
    fmt::print("loops: {} of {} places seen before are believed\n", json["loops"]["believed"].dump(),
               json["loops"]["keyframes"].dump());
  }
  if (motion.detection.bridged + motion.signal.bridged > 0) {
    fmt::print("bridged: {} of the steps, {} of {} frames with too few points\n", motion.detection.bridged,
               motion.signal.bridged, walk.frames());
  }
}

}  // namespace

Command add_odometry(CLI::App& root) {
  auto options = std::make_shared<OdometryOptions>();
  CLI::App* app = root.add_subcommand("odometry", "steps, headings and the trajectory of a walk");
  app->add_option("walk", options->walk, "video file, folder of images, or camera:N")->required();
  app->add_option("-o,--output", options->output, "folder for the results")->required();
  app->add_option("--walk-length-m", options->walk_length_m,
                  "metres, known length of this walk: measures the step length, for --step-length on others")
      ->check(CLI::PositiveNumber);
  app->add_flag("--close-loops", options->close_loops,
                "find where the walk comes back to its own path, and correct the trajectory's drift by it");
  add_frame_options(*app, options->settings);
  add_odometry_options(*app, options->settings);
  add_general_options(*app, options->settings);
  add_config_option(*app, options->common);
  add_force_option(*app, options->common);
  add_json_option(*app, options->common);
  app->footer(
      "Examples:\n"
      "  retrace odometry walk.mp4 -o out --step-length 0.72\n"
      "  retrace odometry twenty_metres.mp4 -o calibration --walk-length-m 20    (prints the step length)\n"
      "  retrace evaluate-odometry out --truth truth.csv");
  return {app, [app, options] { odometry(*app, *options); }};
}

}  // namespace retrace
