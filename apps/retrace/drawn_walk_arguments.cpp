#include "drawn_walk_arguments.hpp"

#include <string>
#include <utility>
#include <vector>

namespace retrace {
namespace {

template <typename T>
void add(Arguments& arguments, const char* group, const char* name, T& target, const char* description) {
  arguments.option(name, target, description).group(group);
}

template <typename Choice>
void add_choice(Arguments& arguments, const char* group, const char* name, Choice& target,
                const std::vector<std::pair<std::string, Choice>>& choices, const char* description) {
  arguments.choice(name, target, choices, description).group(group);
}

}  // namespace

void declare_drawn_walk(Arguments& arguments, simulate::Options& walk) {
  using simulate::Condition, simulate::Scene, simulate::Speed;
  constexpr const char *kRoute = "Route", *kWalker = "Walker", *kCamera = "Camera";
  add_choice(arguments, kRoute, "--scene", walk.scene,
             {{"street", Scene::kStreet}, {"corridor", Scene::kCorridor}}, "what is walked along");
  add(arguments, kRoute, "--length-m", walk.length_m,
      "metres of route; a longer one begins with the shorter one");
  add(arguments, kRoute, "--seed", walk.seed, "the route and everything along it");
  add_choice(arguments, kRoute, "--condition", walk.condition,
             {{"day", Condition::kDay}, {"night", Condition::kNight}, {"rain", Condition::kRain}},
             "light and weather");
  add_choice(arguments, kWalker, "--speed", walk.speed,
             {{"steady", Speed::kSteady},
              {"slow-fast", Speed::kSlowFast},
              {"fast-slow", Speed::kFastSlow},
              {"varied", Speed::kVaried},
              {"stops", Speed::kStops},
              {"run", Speed::kRun}},
             "how the pace changes on the way");
  add(arguments, kWalker, "--gait-seed", walk.gait_seed,
      "the walker, varied speeds, passers-by and sensor noise");
  add(arguments, kWalker, "--lateral-m", walk.lateral_m, "metres right of the route, left if negative");
  add(arguments, kWalker, "--detour-m", walk.detour_m, "metres walked in all into a side street, and back");
  add(arguments, kWalker, "--start-m", walk.start_m, "metres along the route where the walk begins");
  add(arguments, kWalker, "--people", walk.people, "passers-by met");
  Argument failures = arguments.option(
      "--failures", walk.failures,
      "stretches, spread evenly, in which the camera tells nothing of its motion: by turns black, out of "
      "focus, turned aside and back, before a blank wall [SSS Fig. 9]");
  failures.group(kCamera);
  arguments.option("--failure-s", walk.failure_s, "seconds that each lasts").group(kCamera).needs(failures);
  add(arguments, kCamera, "--camera-yaw-deg", walk.camera_yaw_deg,
      "degrees that the camera is turned to the right");
  add(arguments, kCamera, "--camera-pitch-deg", walk.camera_pitch_deg,
      "degrees that the camera is turned upwards");
  add(arguments, kCamera, "--fov-deg", walk.fov_deg, "degrees from left to right [PVO 5.3]");
  add(arguments, kCamera, "--frame-rate-hz", walk.frame_rate_hz, "frames per second [PVO 5.1]");
  add(arguments, kCamera, "--width", walk.size.width, "pixels [PVO 5.1]");
  add(arguments, kCamera, "--height", walk.size.height, "pixels [PVO 5.1]");
}

}  // namespace retrace
