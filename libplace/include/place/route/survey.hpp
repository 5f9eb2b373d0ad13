#pragma once

#include "place/route/walk_sampling.hpp"

#include <filesystem>
#include <optional>
#include <string>

#include <vo/io/pose_series_io.hpp>
#include <vo/odometry.hpp>

/// Positions from a surveyor, a GPS receiver or another program, assigned to a walk's frames.
namespace place {

/// Settings of `survey_from_trajectory` and `survey_from_track`.
struct SurveyOptions {
  /// Time on the file's clock at the first frame (for a GPX file, since its first point). None: a clock with
  /// a date is matched with the video's creation time, if that puts at least half of the video within the
  /// file; otherwise the file begins with the video.
  std::optional<double> start_s;
  /// Longest time between two poses that is interpolated, seconds. None: three times the file's usual
  /// interval, and at least `kTrajectoryGap_s` or `kTrackGap_s`.
  std::optional<double> max_gap_s;
  vo::TrajectoryAxes axes = vo::TrajectoryAxes::kAuto;
  std::string track_name;  ///< name of the track to read from a GPX file (`TrackOptions`)
};
inline constexpr double kTrajectoryGap_s = 2;  ///< a bend in a walk takes longer
inline constexpr double kTrackGap_s = 20;      ///< receivers leave out points on straights

/// Poses and distances of a walk's frames from `truth.csv`, where it has them. Throws `vo::Error` unless it
/// has one row for each frame, and if all of them are empty.
Survey survey_from_truth(const std::filesystem::path& path, const vo::Walk& walk);

/// The same from a trajectory (`vo::read_pose_series`). Frames outside it or in its gaps have no pose; the
/// distance is the length of the path between the frames' positions, straight over gaps. Throws `vo::Error`
/// if no frame has a pose, or a file without times does not have one for each frame.
Survey survey_from_trajectory(const std::filesystem::path& path, const vo::Walk& walk,
                              const SurveyOptions& options = {});

/// The same from a GPS track (`read_track`), with no pose between its segments. Poses are in metres from the
/// origin, which becomes the track's first point if there is none.
Survey survey_from_track(const std::filesystem::path& path, const vo::Walk& walk,
                         std::optional<GeographicOrigin>& origin, const SurveyOptions& options = {});

/// The same for a traverse of `route`, whose origin it uses or sets. Throws `vo::Error` if the route has
/// surveyed poses that are not geographic: metres from an origin would not fit them.
Survey survey_from_track(const std::filesystem::path& path, const vo::Walk& walk, Route& route,
                         const SurveyOptions& options = {});

/// For a walk without a survey: the poses of its odometry, one for each frame, without distances. None if
/// there is no odometry.
std::optional<Survey> survey_from_odometry(const vo::Trajectory& odometry);

}  // namespace place
