#include "gait.hpp"

#include "noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <vo/base/rng.hpp>

namespace simulate {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr double kMinStep_m = 0.25;  // shuffling off from a stand

// Smoothly 0 at rest, 1 from an unhurried walk on.
double walking_share(double speed_mps) {
  const double t = std::clamp(speed_mps / 0.4, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

Walker draw_walker(std::uint64_t gait_seed) {
  vo::Rng rng = vo::Rng(gait_seed).split();
  Walker walker{};
  // Walk ratio 0.36 m/Hz is 0.7 m at 1.93 Hz: the step length PVO uses at the usual speed. It is near the
  // 0.0065 m/(steps/min) of Sekiya and Nagasaki (Gait & Posture, 1998); people differ by some 5 %.
  walker.walk_ratio_m_s = 0.363 * rng.uniform(0.95, 1.05);
  // Comfortable walking speed of adults: 1.27 to 1.46 m/s (Bohannon, Age and Ageing, 1997).
  walker.preferred_speed_mps = rng.uniform(1.27, 1.46);
  // The breast bone is at three quarters of the stature, here 1.64 to 1.88 m.
  walker.camera_height_m = rng.uniform(1.23, 1.41);
  // A strap is put on by hand: a few degrees off, slightly downwards under a camera's weight as often as
  // upwards.
  walker.mount_pitch_rad = rng.uniform(-2, 3) * kDegree;
  walker.mount_roll_rad = rng.uniform(-1.5, 1.5) * kDegree;
  // People differ by a quarter in how much they swing; the phases by an eighth of a cycle.
  for (double* scale :
       {&walker.sway_scale, &walker.bob_scale, &walker.roll_scale, &walker.yaw_scale, &walker.pitch_scale}) {
    *scale = rng.uniform(0.75, 1.25);
  }
  for (double* phase : {&walker.roll_phase_rad, &walker.yaw_phase_rad, &walker.pitch_phase_rad}) {
    *phase = rng.uniform(-kPi / 4, kPi / 4);
  }
  walker.asymmetry = rng.uniform(-0.25, 0.25);  // no two legs are alike
  walker.seed = static_cast<std::uint32_t>(rng.bits());
  return walker;
}

double step_length_m(const Walker& walker, double speed_mps) {
  return std::max(kMinStep_m, std::sqrt(walker.walk_ratio_m_s * std::max(0.0, speed_mps)));
}

double step_variation(const Walker& walker, std::int64_t step) {
  // The stride time of healthy adults varies by 2 to 3 %; uniform over +-4 % has a deviation of 2.3 %.
  return 0.96 + 0.08 * lattice_uniform(static_cast<std::int32_t>(step), 1, walker.seed);
}

Swing swing_at(const Walker& walker, double steps, double speed_mps, double time_s) {
  const double walking = walking_share(speed_mps);
  const double stride = kPi * steps;  // a stride is two steps
  const double step = 2 * kPi * steps;
  // The body's centre moves sideways by 7.0 cm in all at 0.7 m/s and 3.9 cm at 1.6 m/s, and up and down
  // by 2.7 cm and 4.8 cm (Orendurff et al., J Rehabil Res Dev, 2004). Both are continued to a run as straight
  // lines, the first down to 2 cm.
  const double sway_m = std::max(0.02, 0.070 - 0.034 * (speed_mps - 0.7)) / 2;
  const double bob_m = std::max(0.015, 0.027 + 0.023 * (speed_mps - 0.7)) / 2;
  // Pelvis and trunk turn by about 4 degrees to either side and lean by 5 (Saunders, Inman, Eberhart, J Bone
  // Joint Surg, 1953); the chest, which steadies the head, by less than half of it. A camera's gyroscope on a
  // footpath walk shows 0.5 to 1 degree about each axis at stride frequency, with two hands steadying it, and
  // as much in pitch at step frequency. A chest strap lies between. Growth with speed: in proportion to step
  // length.
  const double vigour = step_length_m(walker, speed_mps) / 0.7;
  const double roll = 1.8 * kDegree * vigour;
  const double yaw = 1.6 * kDegree * vigour;
  const double pitch = 0.6 * kDegree * vigour;

  Swing swing;
  swing.right_m = walking * walker.sway_scale * sway_m * std::sin(stride);  // over the standing leg
  swing.up_m = -walking * walker.bob_scale * bob_m * std::cos(step);        // lowest with both feet down
  swing.roll_rad = walking * walker.roll_scale * roll *
                   (std::sin(stride + walker.roll_phase_rad) + walker.asymmetry * std::sin(step));
  swing.yaw_rad = walking * walker.yaw_scale * yaw * std::cos(stride + walker.yaw_phase_rad);
  swing.pitch_rad = walking * walker.pitch_scale * pitch * std::cos(step + walker.pitch_phase_rad);

  // At rest one breathes some 15 times a minute, which lifts and tilts the chest by millimetres and tenths of
  // a degree, and balances a few millimetres to and fro at about half that rate. Neither stops with walking.
  const double breath = 2 * kPi * 0.25 * time_s + walker.yaw_phase_rad;
  const double balance = 2 * kPi * 0.13 * time_s + walker.roll_phase_rad;
  swing.up_m += 0.003 * std::sin(breath);
  swing.pitch_rad += 0.3 * kDegree * std::sin(breath);
  swing.right_m += 0.004 * std::sin(balance);
  swing.roll_rad += 0.15 * kDegree * std::sin(balance);
  swing.yaw_rad += 0.2 * kDegree * std::sin(0.7 * balance);
  return swing;
}

Wander wander_at(const Walker& walker, double walked_m) {
  // No one keeps a line drawn on a pavement: about 0.1 m and 2 degrees, over some steps to some tens of
  // metres, chosen so that a walker stays on the pavement and in the corridor.
  static constexpr std::array<double, 3> kWave_m{9.7, 17.9, 41.3};
  Wander wander{0, 0};
  for (std::int32_t i = 0; i < 3; ++i) {
    const double wave = 2 * kPi * walked_m / kWave_m[static_cast<std::size_t>(i)];
    const double shift = 2 * kPi * lattice_uniform(i, 2, walker.seed);
    const double turn = 2 * kPi * lattice_uniform(i, 3, walker.seed);
    wander.right_m += 0.07 * std::sin(wave + shift);
    wander.yaw_rad += 1.4 * kDegree * std::sin(1.3 * wave + turn);
  }
  return wander;
}

}  // namespace simulate
