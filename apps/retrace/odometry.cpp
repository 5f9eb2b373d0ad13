#include "choice.hpp"
#include "close_loops.hpp"
#include "command.hpp"
#include "progress_bar.hpp"
#include "report/odometry_report.hpp"
#include "run_directory.hpp"
#include "settings.hpp"
#include "visual_odometry.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
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
  bool visual_odometry = false;
  bool close_loops = false;
};

/// What displacements are measured in: without steps, visual odometry has a unit of its own.
std::string_view unit_of(const vo::Walk& walk, const vo::WalkMotion& motion) {
  if (motion.metric) return "m";
  return walk.track ? "units" : "frames";
}

/// What a source by itself tells of a frame, in a unit of its own.
struct Told {
  std::optional<double> displacement;
  int unit = 0;
};

/// The same with all frames of one unit brought to the length that `motion` has over them.
std::vector<std::optional<double>> to_common_unit(const std::vector<Told>& told,
                                                  const vo::WalkMotion& motion) {
  std::map<int, std::pair<double, double>> lengths;  // by unit: as told, of `motion`
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (!told[i].displacement) continue;
    auto& [own, common] = lengths[told[i].unit];
    own += *told[i].displacement;
    common += motion.frames[i].value;
  }
  std::vector<std::optional<double>> displacement;
  for (const Told& frame : told) {
    const auto& [own, common] = lengths[frame.unit];
    const bool known = frame.displacement && own > 0;
    displacement.push_back(known ? std::optional(*frame.displacement * common / own) : std::nullopt);
  }
  return displacement;
}

std::string frames_csv(const vo::Walk& walk, const vo::WalkMotion& motion) {
  std::string csv =
      "frame,time_s,displacement,unit,source,orientation_deg,dx_px,matches,heading_deg,"
      "step_signal,step_threshold,reliable,x_m,y_m,displacement_sigma,vo_displacement,sad_displacement\n";
  std::vector<Told> by_vo(walk.frames()), by_sad(walk.frames());
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    if (walk.track && walk.track->frames[i].valid)
      by_vo[i] = {walk.track->frames[i].displacement, walk.track->frames[i].segment};
    if (motion.visual) by_sad[i] = {motion.visual->displacement[i]};
  }
  const auto vo_displacement = to_common_unit(by_vo, motion),
             sad_displacement = to_common_unit(by_sad, motion);
  const vo::PedestrianMotion& gait = *motion.pedestrian;
  const std::vector<double>& signal = vo::values_of(gait.step_signal, gait.signal);
  const std::string_view unit = unit_of(walk, motion);
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    const vo::FrameMotion& tracked = walk.tracked[i];
    const vo::FrameDisplacement& moved = motion.frames[i];
    const vo::Pose2& pose = motion.trajectory[i].pose;
    const auto measured = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.6f}", *value) : std::string();
    };
    csv += fmt::format("{},{:.6f},{:.6f},{},{},{},{},{},{:.6f},{:.6f},{:.6f},{},{:.6f},{:.6f},{:.6f},{},{}\n",
                       i, walk.time_s[i], moved.value, unit, vo::name_of(moved.source),
                       measured(tracked.orientation_deg), measured(tracked.shift_px), tracked.matches,
                       gait.signal.heading_rad[i] * kDegrees, signal[i], gait.detection.delta_dyn_deg[i],
                       gait.signal.reliable[i] ? 1 : 0, pose.x_m, pose.y_m, moved.sigma,
                       measured(vo_displacement[i]), measured(sad_displacement[i]));
  }
  return csv;
}

std::string steps_csv(const vo::WalkMotion& motion) {
  std::string csv = "step,frame,time_s,leg,x_m,y_m,heading_deg,length_m,bridged\n";
  const vo::PedestrianMotion& gait = *motion.pedestrian;
  for (std::size_t i = 0; i < gait.detection.steps.size(); ++i) {
    const vo::Step& step = gait.detection.steps[i];
    const vo::Pose2& pose = motion.trajectory[step.frame].pose;
    csv += fmt::format("{},{},{:.6f},{},{:.6f},{:.6f},{:.6f},{:.6f},{}\n", i + 1, step.frame, step.time_s,
                       step.leg == vo::Leg::kLeft ? "left" : "right", pose.x_m, pose.y_m,
                       gait.trajectory.at_step[i].heading_rad * kDegrees, gait.step_length_m[i],
                       step.bridged ? 1 : 0);
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

constexpr std::string_view name_of(vo::StepSignal signal) {
  switch (signal) {
    case vo::StepSignal::kBounce:
      return "bounce";
    case vo::StepSignal::kShift:
      return "x shift";
    case vo::StepSignal::kOrientation:
      break;
  }
  return "orientation";
}

ordered_json summary(const vo::Walk& walk, const vo::WalkMotion& walked, double step_length_m) {
  const vo::PedestrianMotion& motion = *walked.pedestrian;
  double distance = 0;
  std::map<std::string, std::size_t> sources;
  for (const vo::FrameDisplacement& frame : walked.frames) {
    distance += frame.value;
    if (frame.source != vo::DisplacementSource::kNone) ++sources[std::string(vo::name_of(frame.source))];
  }
  ordered_json json{
      {"walk", walk.source},
      {"frames", walk.frames()},
      {"duration_s", walk.time_s.back()},
      {"steps", motion.detection.steps.size()},
      {"step_signal", std::string(name_of(motion.step_signal))},
      {"step_signal_unit", motion.step_signal == vo::StepSignal::kOrientation ? "deg a frame" : "px a frame"},
      {"steps_bridged", motion.detection.bridged},
      {"frames_bridged", motion.signal.bridged},
      {"step_length_m", step_length_m},
      {"distance", distance},
      {"unit", unit_of(walk, walked)},
      {"distance_m", nullptr},
      {"frames_by_source", sources},
      {"delta_min", nullptr},
      {"warnings", walk.warnings},
      {"version", place::kVersion}};
  for (const vo::Activity activity :
       {vo::Activity::kStanding, vo::Activity::kWalking, vo::Activity::kRunning, vo::Activity::kUnknown}) {
    json["activity_s"][std::string(name_of(activity))] =
        std::ranges::count(motion.activity, activity, &vo::ActivitySecond::activity);
  }
  if (walked.metric) json["distance_m"] = distance;
  if (motion.detection.delta_min_deg) json["delta_min"] = *motion.detection.delta_min_deg;
  return json;
}

/// By the source asked for; by steps alone where the others tell nothing, or too few frames a second show no
/// steps.
vo::WalkMotion walked_motion(const vo::Walk& walk, const Settings& settings) {
  if (settings.sampling.sampling.motion == vo::MotionSource::kHybrid) {
    try {
      vo::WalkMotion motion = vo::walk_motion(walk, vo::MotionSource::kHybrid, settings.sampling.motion);
      if (motion.pedestrian) return motion;
    } catch (const vo::Error& error) {
      spdlog::warn("{}; steps alone are used", error.what());
    }
  }
  return vo::walk_motion(walk, vo::MotionSource::kSteps, settings.sampling.motion);
}

void odometry(const CLI::App& app, OdometryOptions& options) {
  Settings& settings = options.settings;
  vo::set_thread_count(settings.threads);
  resolve(app, settings);
  const fs::path folder = options.output;
  prepare_run_directory(folder,
                        {"frames.csv", "steps.csv", "activity.csv", "trajectory.tum", "summary.json",
                         "report.html", "config.toml", "visual_odometry.csv", "visual_odometry.tum"},
                        options.common.force);

  settings.walk.preview_width_px = 0;
  vo::keep_for(settings.sampling.sampling.motion, settings.walk);
  settings.walk.track_features = true;
  settings.walk.visual_odometry = settings.walk.visual_odometry || options.visual_odometry;
  vo::Walk walk;
  {
    ProgressBar bar;
    walk = vo::read_walk(options.walk, settings.walk, bar.callback());
  }
  for (const std::string& warning : walk.warnings) spdlog::warn("{}", warning);
  vo::PedestrianMotionOptions& pedestrian = settings.sampling.motion.pedestrian;
  if (options.walk_length_m) {
    const double steps = vo::steps_made(vo::pedestrian_motion(walk, pedestrian).detection);
    if (steps == 0) {
      throw vo::Error(options.walk, "shows no steps", "a walk of the length given with --walk-length-m");
    }
    pedestrian.step_length.length_m = vo::calibrated_step_length_m(*options.walk_length_m, steps);
  }
  const vo::WalkMotion walked = walked_motion(walk, settings);
  const vo::PedestrianMotion& motion = *walked.pedestrian;

  ordered_json json = summary(walk, walked, pedestrian.step_length.length_m);
  vo::Trajectory trajectory = walked.trajectory;
  if (options.close_loops) {
    ClosedLoops closed = close_loops(walk, walked, {.patch = settings.patch});
    json["loops"] = {{"keyframes", closed.loops}, {"believed", closed.believed}};
    trajectory = std::move(closed.trajectory);
    vo::write_file(folder / "trajectory_odometry.tum",
                   vo::to_tum(walked.trajectory, "the same before loops were closed"));
  }
  vo::write_file(folder / "frames.csv", frames_csv(walk, walked));
  vo::write_file(folder / "steps.csv", steps_csv(walked));
  vo::write_file(folder / "activity.csv", activity_csv(motion));
  vo::write_file(folder / "trajectory.tum",
                 vo::to_tum(trajectory, "pose of each frame, metres and radians since the first"));
  if (options.visual_odometry) write_visual_odometry(walk, folder);
  vo::write_file(folder / "summary.json", json.dump(2) + "\n");
  vo::write_file(folder / "config.toml", to_toml(settings));
  vo::write_file(folder / "report.html", odometry_report(folder));
  if (options.common.json) {
    fmt::print("{}\n", json.dump(2));
    return;
  }
  const auto row = [](std::string_view name, const std::string& value, const std::string& note) {
    fmt::print("  {:<10}{:>10}   {}\n", name, value, note);
  };
  fmt::print("{}\n", walk.source);
  row("steps", std::to_string(motion.detection.steps.size()),
      fmt::format("{} of them bridged", motion.detection.bridged));
  row("distance", fmt::format("{:.1f} {}", json["distance"].get<double>(), json["unit"].get<std::string>()),
      walked.metric ? fmt::format("steps of {:.3f} m", pedestrian.step_length.length_m)
                    : "no steps, so no metres: see --camera-height-m");
  row("duration", fmt::format("{:.1f} s", walk.time_s.back()),
      fmt::format("{} frames, {} with too few points", walk.frames(), motion.signal.bridged));
  if (options.close_loops) {
    row("loops", json["loops"]["keyframes"].dump(),
        fmt::format("places seen before, {} of them believed", json["loops"]["believed"].dump()));
  }
  fmt::print("see {}\n", (folder / "report.html").string());
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
  app->add_flag("--visual-odometry", options->visual_odometry,
                "write visual_odometry.csv and .tum as well: the camera's way, with what it was lost by");
  options->settings.sampling.sampling.motion = vo::MotionSource::kHybrid;
  add_choice(*app, "Pedestrian odometry", "--motion", options->settings.sampling.sampling.motion,
             {{"hybrid", vo::MotionSource::kHybrid}, {"steps", vo::MotionSource::kSteps}},
             "displacement by steps and visual odometry [SSS 3.5], or by steps alone [PVO]");
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
