#include "place/route/motion_choice.hpp"

#include "place/resolve.hpp"

#include <algorithm>
#include <stdexcept>

#include <vo/base/error.hpp>

namespace place {
namespace {

constexpr double kLeastGait = 0.5;  // share of the motion

/// 0 where the frame rate is too low to see steps.
double gait_of(const vo::Walk& walk, const vo::PedestrianMotionOptions& odometry) {
  try {
    const vo::PedestrianMotion motion = vo::pedestrian_motion(walk, odometry);
    return motion.detection.steps.empty() ? 0 : share_of_gait(motion);
  } catch (const vo::Error&) {
    return 0;
  }
}

}  // namespace

double share_of_gait(const vo::PedestrianMotion& motion) {
  const auto is_gait = [](const vo::ActivitySecond& second) {
    return second.activity == vo::Activity::kWalking || second.activity == vo::Activity::kRunning;
  };
  const auto gait = std::ranges::count_if(motion.activity, is_gait);
  const auto standing =
      std::ranges::count(motion.activity, vo::Activity::kStanding, &vo::ActivitySecond::activity);
  const auto moving = static_cast<std::ptrdiff_t>(motion.activity.size()) - standing;
  return moving == 0 ? 0 : static_cast<double>(gait) / static_cast<double>(moving);
}

MotionChoice choose_motion(const Settings& resolved, const vo::Walk& walk,
                           const vo::PedestrianMotionOptions& odometry) {
  if (resolved.motion != "auto") throw std::invalid_argument("choose_motion: motion auto expected");
  MotionChoice choice{.settings = resolved, .gait_share = gait_of(walk, odometry)};
  Settings& settings = choice.settings;
  settings.motion = choice.gait_share >= kLeastGait ? "steps" : "sad";
  if (settings.motion == "steps" && settings.spacing_m) settings.sampling_n.reset();
  if (settings.motion == "sad" && !settings.sampling_n)
    throw vo::Error(walk.source, "shows no steps, so its motion is not in metres",
                    "no spacing-m, or a walk on foot");
  settings = resolve(settings, {.purpose = Purpose::kRoute, .drop_ineffective = true});
  return choice;
}

}  // namespace place
