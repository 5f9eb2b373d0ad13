#include "simulator.hpp"

#include "corridor.hpp"
#include "street.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace simulate {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const Options& valid(const Options& options) {
  validate(options);
  return options;
}

World build_world(const Options& options, const Route& route) {
  WorldBuilder builder;
  if (options.scene == Scene::kStreet) {
    build_street(route, options.seed, options.condition, builder);
  } else {
    build_corridor(route, options.seed, builder);
  }
  return builder.finish(options.scene, options.condition);
}

// One looks into a corner before one is in it, and the trunk does not turn at once: the mean of the path's
// headings from half a step behind to two steps ahead.
double body_heading_rad(const WalkPath& path, double walked_m) {
  double sum = 0;
  constexpr std::array kOffsets_m{-0.3, 0.0, 0.3, 0.6, 0.9, 1.2};
  for (const double offset : kOffsets_m) sum += path.at(walked_m + offset).heading_rad;
  return sum / kOffsets_m.size();
}

// The camera's axes for a heading clockwise from north, a pitch upwards and a roll clockwise.
Eigen::Matrix3d camera_axes(double yaw, double pitch, double roll) {
  const Eigen::Vector3d forward(std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch),
                                std::sin(pitch));
  const Eigen::Vector3d level_right(std::cos(yaw), -std::sin(yaw), 0);
  const Eigen::Vector3d level_down = forward.cross(level_right);
  Eigen::Matrix3d axes;
  axes.col(0) = level_right * std::cos(roll) + level_down * std::sin(roll);
  axes.col(1) = level_down * std::cos(roll) - level_right * std::sin(roll);
  axes.col(2) = forward;
  return axes;
}

}  // namespace

WalkSimulator::WalkSimulator(const Options& options)
    : options_(valid(options)),
      route_(make_route(options.scene, options.seed, options.length_m)),
      path_(route_, options.start_m, options.length_m, options.detour_m),
      walker_(draw_walker(options.gait_seed)),
      timetable_(options.speed, path_.walked_m(), walker_, options.gait_seed),
      world_(build_world(options, route_)),
      failures_(spread_failures(options.failures, options.failure_s, timetable_.duration_s())),
      exposure_(exposure_for(options.condition)),
      frame_count_(1 + static_cast<int>(timetable_.duration_s() * options.frame_rate_hz)) {
  const double room_m = options.scene == Scene::kStreet ? 1.8 : 0.8;
  people_ = draw_people(
      options.people, timetable_.duration_s(),
      [this](double time_s) { return path_.route_distance_m(timetable_.at(time_s).walked_m); },
      options.lateral_m, room_m, options.condition == Condition::kNight, options.gait_seed);
}

double WalkSimulator::time_of(int frame) const {
  if (frame < 0 || frame >= frame_count_) throw std::out_of_range("WalkSimulator: no such frame");
  return frame / options_.frame_rate_hz;
}

WalkSimulator::Body WalkSimulator::body_at(double time_s) const {
  const Timetable::Entry entry = timetable_.at(time_s);
  const Wander wander = wander_at(walker_, entry.walked_m);
  vo::Pose2 pose = moved_right(path_.at(entry.walked_m), options_.lateral_m + wander.right_m);
  pose.heading_rad = body_heading_rad(path_, entry.walked_m) + wander.yaw_rad;
  return {pose, entry};
}

Camera WalkSimulator::camera_at(double time_s) const {
  const Body body = body_at(time_s);
  const Swing swing = swing_at(walker_, body.entry.steps, body.entry.speed_mps, time_s);
  const std::optional<Failure> failure = failure_at(failures_, time_s);
  const double pan = failure ? pan_rad(*failure, time_s) : 0;
  const double s = options_.swing;
  const vo::Pose2 chest = moved_right(body.pose, s * swing.right_m);
  Camera camera;
  camera.size = options_.size;
  camera.focal_px = options_.size.width / (2 * std::tan(options_.fov_deg * kDegree / 2));
  camera.world_from_camera.linear() =
      camera_axes(chest.heading_rad + options_.camera_yaw_deg * kDegree + pan + s * swing.yaw_rad,
                  walker_.mount_pitch_rad + options_.camera_pitch_deg * kDegree + s * swing.pitch_rad,
                  walker_.mount_roll_rad + s * swing.roll_rad);
  camera.world_from_camera.translation() << chest.x_m, chest.y_m, walker_.camera_height_m + s * swing.up_m;
  return camera;
}

cv::Mat WalkSimulator::picture_at(double time_s) const {
  const Camera camera = camera_at(time_s);
  std::vector<Surface> surfaces = world_.surfaces;
  const std::vector<Surface> figures =
      people_at(people_, route_.path, time_s, camera.world_from_camera.translation(), world_.lighting);
  surfaces.insert(surfaces.end(), figures.begin(), figures.end());
  cv::Mat picture;
  rasterise(surfaces, world_.backdrop, camera, world_.lighting.haze(), picture,
            exposure_.samples > 1 ? 1 : kFineTaps);
  return picture;
}

TruthRow WalkSimulator::truth(int frame) const {
  const double time_s = time_of(frame);
  const Body body = body_at(time_s);
  return {frame,
          time_s,
          body.pose.x_m,
          body.pose.y_m,
          body.pose.heading_rad / kDegree,
          path_.route_distance_m(body.entry.walked_m),
          static_cast<int>(body.entry.steps)};
}

Camera WalkSimulator::camera(int frame) const {
  return camera_at(time_of(frame));
}

cv::Mat WalkSimulator::render(int frame) const {
  const double middle_s = time_of(frame);
  std::vector<cv::Mat> pictures;
  for (int i = 0; i < exposure_.samples; ++i) {
    const double share = (i + 0.5) / exposure_.samples - 0.5;
    pictures.push_back(picture_at(middle_s + share * exposure_.shutter_s));
  }
  cv::Mat image = average(pictures);
  const std::uint64_t seed = options_.gait_seed * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(frame);
  if (options_.condition == Condition::kRain && options_.scene == Scene::kStreet) {
    add_raindrops(image, options_.size.area() / 1500, seed);
  }
  if (const std::optional<Failure> failure = failure_at(failures_, middle_s)) spoil(image, failure->kind);
  add_noise(image, exposure_.noise, seed);
  return image;
}

}  // namespace simulate
