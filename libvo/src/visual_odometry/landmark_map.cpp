#include "vo/visual_odometry/landmark_map.hpp"

#include "vo/geometry/bundle_adjustment.hpp"
#include "vo/geometry/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace vo {
namespace {

/// The first of the last `window` keyframes.
std::size_t window_begin(const LandmarkMap& map, const LandmarkMapOptions& options) {
  return map.keyframes.size() - std::min(map.keyframes.size(), options.window);
}

std::optional<cv::Vec3d> placed(const LandmarkMap& map, const Landmark& landmark,
                                const LandmarkMapOptions& options) {
  std::vector<Pose3> cameras;
  std::vector<ImagePoint> seen;
  for (const Landmark::Sighting& sighting : landmark.sightings) {
    cameras.push_back(map.keyframes[sighting.keyframe].pose);
    seen.push_back(sighting.at);
  }
  double parallax_rad = 0;
  const cv::Vec3d last = ray_of(cameras.back(), seen.back());
  for (std::size_t i = 0; i + 1 < cameras.size(); ++i)
    parallax_rad = std::max(parallax_rad, angle_between_rad(ray_of(cameras[i], seen[i]), last));
  if (parallax_rad < options.min_parallax_rad) return std::nullopt;
  const std::optional<cv::Vec3d> point = triangulate(cameras, seen);
  if (!point) return std::nullopt;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const ImagePoint at = *project(cameras[i], *point);
    if (std::hypot(at.x - seen[i].x, at.y - seen[i].y) > options.max_off * options.noise) return std::nullopt;
  }
  return point;
}

/// Removes another radial distortion from all image points.
void set_radial(LandmarkMap& map, double radial) {
  const auto changed = [&](const ImagePoint& at) {
    return without_radial(with_radial(at, map.radial), radial);
  };
  for (Landmark& landmark : map.landmarks) {
    landmark.at = changed(landmark.at);
    for (Landmark::Sighting& sighting : landmark.sightings) sighting.at = changed(sighting.at);
  }
  map.radial = radial;
}

}  // namespace

void add_keyframe(LandmarkMap& map, const Keyframe& keyframe) {
  const std::size_t index = map.keyframes.size();
  map.keyframes.push_back(keyframe);
  for (Landmark& landmark : map.landmarks) {
    if (landmark.followed) landmark.sightings.push_back({index, landmark.at});
  }
}

void place_landmarks(LandmarkMap& map, const LandmarkMapOptions& options) {
  for (Landmark& landmark : map.landmarks) {
    if (landmark.followed && !landmark.position && landmark.sightings.size() >= 2)
      landmark.position = placed(map, landmark, options);
  }
}

void adjust_window(LandmarkMap& map, const LandmarkMapOptions& options) {
  const std::size_t begin = window_begin(map, options);
  Bundle bundle;
  std::map<std::size_t, std::size_t> pose_of_keyframe;
  std::vector<Landmark*> landmarks;
  struct Source {
    std::size_t landmark, sighting;
  };
  std::vector<Source> sources;
  for (Landmark& landmark : map.landmarks) {
    if (!landmark.position || landmark.sightings.back().keyframe < begin) continue;
    for (std::size_t i = 0; i < landmark.sightings.size(); ++i) {
      const Landmark::Sighting& sighting = landmark.sightings[i];
      const auto [pose, added] = pose_of_keyframe.try_emplace(sighting.keyframe, bundle.poses.size());
      if (added) {
        bundle.poses.push_back(map.keyframes[sighting.keyframe].pose);
        bundle.pose_fixed.push_back(sighting.keyframe < begin || sighting.keyframe == 0);
      }
      bundle.observations.push_back({pose->second, landmarks.size(), with_radial(sighting.at, map.radial)});
      sources.push_back({landmarks.size(), i});
    }
    bundle.points.push_back(*landmark.position);
    landmarks.push_back(&landmark);
  }
  bundle.radial = map.radial;
  BundleOptions adjustment{.noise = options.noise};
  if (begin > 0 && options.radial_step > 0) {  // the first keyframes alone do not determine it
    const double calibration = 1 / (options.radial_sigma * options.radial_sigma);
    const double step = 1 / (options.radial_step * options.radial_step);
    adjustment.radial_mean = map.radial * step / (step + calibration);
    adjustment.radial_sigma = 1 / std::sqrt(step + calibration);
  }
  if (landmarks.empty() || !adjust(bundle, adjustment)) return;
  for (const auto& [keyframe, pose] : pose_of_keyframe) map.keyframes[keyframe].pose = bundle.poses[pose];
  for (std::size_t i = 0; i < landmarks.size(); ++i) landmarks[i]->position = bundle.points[i];

  const std::vector<double> errors = reprojection_errors(bundle);
  for (std::size_t i = sources.size(); i-- > 0;) {  // backwards, so that earlier sightings keep their index
    if (errors[i] <= options.max_off * options.noise) continue;
    Landmark& landmark = *landmarks[sources[i].landmark];
    const auto sighting = landmark.sightings.begin() + static_cast<std::ptrdiff_t>(sources[i].sighting);
    if (sighting->keyframe + 1 == map.keyframes.size()) landmark.followed = false;  // drifted off
    landmark.sightings.erase(sighting);
  }
  if (bundle.radial != map.radial) set_radial(map, bundle.radial);
  for (Landmark* landmark : landmarks) {
    if (landmark->sightings.size() >= 2) continue;
    landmark->position.reset();
    landmark->followed = false;
  }
}

void prune(LandmarkMap& map, const LandmarkMapOptions& options) {
  const std::size_t begin = window_begin(map, options);
  std::erase_if(map.landmarks, [&](const Landmark& landmark) {
    if (landmark.followed) return false;
    return !landmark.position || landmark.sightings.back().keyframe < begin;
  });
}

}  // namespace vo
