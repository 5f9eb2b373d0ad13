#include "place/evaluation/odometry_sweep.hpp"

#include "place/resolve.hpp"
#include "place/stage_options.hpp"

#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/trajectory_io.hpp>
#include <vo/motion/walk_motion.hpp>

namespace place {
namespace {

/// The settings of a value. Throws `vo::Error` for a setting that odometry does not have.
Settings settings_with(const Settings& base, const SweepAxis& axis, const std::string& value) {
  const Setting& setting = setting_named(axis.setting);
  const bool of_odometry = setting.group == SettingGroup::kReading ||
                           setting.group == SettingGroup::kMotion || setting.group == SettingGroup::kOdometry;
  if (!of_odometry || setting.name == "motion-file")
    throw vo::Error("--vary " + axis.setting, "cannot vary", "a setting of reading, motion or odometry");
  Settings settings = base;
  set(settings, setting, value);
  const Settings resolved = resolve(settings, {.purpose = Purpose::kOdometry});
  if (!text_of(resolved, setting))
    throw vo::Error("--vary " + axis.setting, "has no effect on odometry", "another setting");
  return resolved;
}

double percent_less(double value, double base) {
  return base > 0 ? 100 * (1 - value / base) : 0;
}

}  // namespace

OdometryImprovement improvement(const OdometryErrors& errors, const OdometryErrors& base) {
  return {.euclidean_pct = percent_less(errors.euclidean_mean_m, base.euclidean_mean_m),
          .euclidean_sd_pct = percent_less(errors.euclidean_sd_m, base.euclidean_sd_m),
          .heading_deg = std::abs(errors.heading_mean_deg) - std::abs(base.heading_mean_deg),
          .heading_sd_deg = errors.heading_sd_deg - base.heading_sd_deg};
}

std::vector<OdometrySweepRow> sweep_odometry(std::span<const OdometrySweepWalk> walks,
                                             const Settings& settings, const SweepAxis& axis,
                                             const OdometryEvaluationOptions& options) {
  const bool read_anew = setting_named(axis.setting).at_reading;
  std::vector<StageOptions> stages;
  bool visual_odometry = false;
  for (const std::string& value : axis.values) {
    stages.push_back(stage_options(settings_with(settings, axis, value), true));
    stages.back().walk.preview_width_px = 0;
    visual_odometry = visual_odometry || stages.back().walk.visual_odometry;
  }
  std::vector<std::vector<OdometryEvaluation>> measured(axis.values.size());
  std::vector<std::vector<StepCount>> counted(axis.values.size());
  std::vector<OdometrySweepRow> rows;
  for (const std::string& value : axis.values) rows.push_back({.value = value});
  for (std::size_t w = 0; w < walks.size(); ++w) {
    const vo::PosesAlongRoute truth = vo::poses_along_route(walks[w].truth);
    const std::int64_t true_steps = vo::steps_in_all(walks[w].truth).value_or(0);
    OdometryEvaluationOptions of_walk = options;
    of_walk.seed += w;  // other starts on each walk
    vo::Walk walk;
    for (std::size_t v = 0; v < rows.size(); ++v) {
      stages[v].walk.visual_odometry = visual_odometry;
      if (v == 0 || read_anew) walk = walks[w].read(stages[v].walk);
      const WalkSamplingOptions& sampling = stages[v].sampling;
      const vo::WalkMotion motion = vo::motion_with_steps(walk, sampling.source, sampling.motion);
      if (!motion.metric)
        throw vo::Error(walks[w].name, "shows no steps, so that its odometry is not in metres",
                        "a walk on foot, or --camera-height-m");
      const auto pairs = pair_by_time(truth.poses, truth.distance_m, motion.trajectory);
      measured[v].push_back(evaluate_odometry(pairs, of_walk));
      if (measured[v].back().segment_m == 0)
        throw vo::Error(walks[w].name,
                        fmt::format("and its truth share {:.1f} m", measured[v].back().distance_m),
                        fmt::format("{} m or more", options.at_m.front()));
      const std::size_t steps = motion.pedestrian->detection.steps.size();
      rows[v].steps += steps;
      if (true_steps > 0) counted[v].push_back({steps, static_cast<std::size_t>(true_steps)});
    }
  }
  for (std::size_t v = 0; v < rows.size(); ++v) {
    rows[v].evaluation = pooled(measured[v]);
    if (!counted[v].empty()) rows[v].step_errors = step_errors(counted[v]);
  }
  return rows;
}

}  // namespace place
