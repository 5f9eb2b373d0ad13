#pragma once

#include <array>
#include <cstdint>

namespace simulate {

/// How one person walks. Two walkers of different gait seeds differ in all of it.
struct Walker {
  double walk_ratio_m_s;  ///< step length over cadence
  double preferred_speed_mps;
  double camera_height_m;
  double mount_pitch_rad, mount_roll_rad;  ///< how the camera hangs on the chest, up and clockwise
  double sway_scale, bob_scale, roll_scale, yaw_scale, pitch_scale;
  double roll_phase_rad, yaw_phase_rad, pitch_phase_rad;
  double asymmetry;  ///< of left and right steps, as a share of the roll
  std::uint32_t seed;
};

Walker draw_walker(std::uint64_t gait_seed);

/// The step length at a speed (m/s), on average. Walking speed is step length times cadence, and adults keep
/// the ratio of the two over the range of speeds, so both grow with the root of the speed.
double step_length_m(const Walker& walker, double speed_mps);

/// This step's length relative to the average; varies from step to step.
double step_variation(const Walker& walker, std::int64_t step);

/// The camera's movement about the walker's own line.
struct Swing {
  double right_m = 0, up_m = 0;
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;  ///< clockwise, up, to the right
};

/// The swing when `steps` (the fraction is how far into the next one) have been taken, at a speed and a time.
/// Walking fades out below 0.4 m/s and breathing and balancing fade in.
Swing swing_at(const Walker& walker, double steps, double speed_mps, double time_s);

/// How far the walker has strayed from the line, and looks away from it.
struct Wander {
  double right_m, yaw_rad;
};

/// The slow wandering after a distance walked: a few incommensurable waves along the way, the same however
/// fast it is walked.
Wander wander_at(const Walker& walker, double walked_m);

}  // namespace simulate
