#include "vo/io/trajectory_axes.hpp"

#include <algorithm>
#include <array>

namespace vo {
namespace {

/// Mean cosines between the path and each of the body's axes, over pieces of the path long enough that jitter
/// does not turn them. None for a body that does not move.
std::optional<cv::Vec3d> along_path(std::span<const Pose3> poses) {
  double extent = 0;
  for (const Pose3& pose : poses) extent = std::max(extent, cv::norm(pose.position - poses[0].position));
  constexpr double kShortestPiece = 0.02;  // of the walk's extent: half a metre on a short walk of 25 m
  cv::Vec3d sum;
  double pieces = 0;
  std::size_t from = 0;
  for (std::size_t i = 1; i < poses.size() && extent > 0; ++i) {
    const cv::Vec3d moved = poses[i].position - poses[from].position;
    const double length = cv::norm(moved);
    if (length < kShortestPiece * extent) continue;
    sum += poses[(from + i) / 2].rotation.t() * moved / length;
    ++pieces;
    from = i;
  }
  if (pieces == 0) return std::nullopt;
  return sum / pieces;
}

/// The world's up as the body's mean up says it.
GroundPlane ground_by(std::span<const Pose3> poses, const cv::Vec3d& body_up) {
  cv::Vec3d up;
  for (const Pose3& pose : poses) up += pose.rotation * body_up / static_cast<double>(poses.size());
  constexpr double kClear = 0.7;  // within 45 degrees
  if (up[2] >= kClear) return GroundPlane::kXY;
  if (up[1] <= -kClear) return GroundPlane::kXZ;
  return GroundPlane::kUnknown;
}

/// The world's ground as the path lies in it.
GroundPlane ground_by_extent(std::span<const Pose3> poses) {
  std::array<double, 3> extent{};
  for (std::size_t k = 0; k < extent.size(); ++k) {
    const auto position = [k](const Pose3& pose) { return pose.position[static_cast<int>(k)]; };
    const auto [low, high] = std::ranges::minmax(poses, {}, position);
    extent[k] = position(high) - position(low);
  }
  constexpr double kFlat = 0.1;
  if (extent[2] < kFlat * extent[1]) return GroundPlane::kXY;
  if (extent[1] < kFlat * extent[2]) return GroundPlane::kXZ;
  return GroundPlane::kUnknown;
}

}  // namespace

FoundAxes find_axes(std::span<const Pose3> poses) {
  const std::optional<cv::Vec3d> along = along_path(poses);
  if (!along) return {BodyAxes::kVehicle, GroundPlane::kXY};
  constexpr double kForward = 0.7, kAhead = 0.3;  // within 45 degrees, and clearly more than the other
  const double x = (*along)[0], z = (*along)[2];
  FoundAxes found;
  if (z >= kForward && z > x + kAhead) {
    found = {BodyAxes::kCamera, ground_by(poses, {0, -1, 0})};
  } else if (x >= kForward && x > z + kAhead) {
    found = {BodyAxes::kVehicle, ground_by(poses, {0, 0, 1})};
  }
  if (found.ground == GroundPlane::kUnknown) found.ground = ground_by_extent(poses);
  return found;
}

}  // namespace vo
