#pragma once

#include "place/route/walk_sampling.hpp"

#include <filesystem>
#include <optional>

#include <vo/odometry.hpp>

/// What a surveyor, a GPS receiver or another program knows of a walk, brought to its frames.
namespace place {

/// Poses and distances of a walk's frames from `truth.csv`. Throws `vo::Error` if it has not one row for each
/// frame.
Survey survey_from_truth(const std::filesystem::path& path, const vo::Walk& walk);

/// The same from a trajectory in TUM's form, on the clock of the walk (seconds since its first frame). Frames
/// outside it have no pose; the distance is the length of the path between the frames' positions. Throws
/// `vo::Error` if no frame has a pose.
Survey survey_from_trajectory(const std::filesystem::path& path, const vo::Walk& walk);

/// The same from a GPS track (`read_track`) on the clock of the walk, a GPX file's since its first
/// point. Poses are metres about the origin, which becomes the track's first point if there is none.
Survey survey_from_track(const std::filesystem::path& path, const vo::Walk& walk,
                         std::optional<GeographicOrigin>& origin);

/// For a walk that nobody surveyed: the poses of its odometry, one for each frame, without distances. None if
/// there is no odometry.
std::optional<Survey> survey_from_odometry(const vo::Trajectory& odometry);

}  // namespace place
