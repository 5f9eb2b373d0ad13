#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

namespace simulate {

enum class Scene { kStreet, kCorridor };
enum class Condition { kDay, kNight, kRain };
enum class Speed { kSteady, kSlowFast, kFastSlow, kVaried, kStops, kRun };

/// One walk. Two walks of one route share `scene` and `seed`; everything else may differ.
struct Options {
  Scene scene = Scene::kStreet;
  Condition condition = Condition::kDay;
  Speed speed = Speed::kSteady;
  double length_m = 120;        ///< of the route, from its beginning; the walk ends there
  std::uint64_t seed = 1;       ///< the route and everything along it
  std::uint64_t gait_seed = 1;  ///< the walker, the `varied` and `stops` speeds, passers-by and sensor noise
  double lateral_m = 0;         ///< how far right of the route the walker keeps
  double camera_yaw_deg = 0;    ///< the camera looks so far to the right of where the walker faces
  double camera_pitch_deg = 0;  ///< and so far upwards, beside how this walker wears it
  int people = 0;               ///< passers-by met along the route
  double detour_m = 0;          ///< walked in all into a side street about half-way, and back; 0: none
  double start_m = 0;           ///< where on the route the walk begins
  int failures = 0;             ///< stretches in which the camera sees nothing that tells its motion
  double failure_s = 3;         ///< how long each is
  double swing = 1;             ///< scale of the camera's swing with the gait; 0 is a stabilised camera
  cv::Size size{640, 360};      ///< PVO 5.1
  double frame_rate_hz = 25;    ///< PVO 5.1
  double fov_deg = 64.4;        ///< horizontal; PVO 5.3 (6)
};

/// Throws `vo::Error` that names the first field out of range, its value and what it must be.
void validate(const Options& options);

}  // namespace simulate
