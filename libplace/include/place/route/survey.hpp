#pragma once

#include "place/route/walk_sampling.hpp"

#include <filesystem>
#include <optional>
#include <string>

#include <vo/io/pose_series_io.hpp>
#include <vo/odometry.hpp>

/// What a surveyor, a GPS receiver or another program knows of a walk, brought to its frames.
namespace place {

/// Settings of `survey_from_trajectory` and `survey_from_track`.
struct SurveyOptions {
  /// What the file's clock shows at the first frame (a GPX file's, since its first point). None: a clock that
  /// says the date is matched with the video's creation time, where that puts half of the video or more
  /// within the file; otherwise the file begins with the video.
  std::optional<double> start_s;
  /// Seconds between two poses beyond which nothing is known in between. None: three times what usually lies
  /// between this file's, and at least `kTrajectoryGap_s` or `kTrackGap_s`.
  std::optional<double> max_gap_s;
  vo::TrajectoryAxes axes = vo::TrajectoryAxes::kAuto;
  std::string track_name;  ///< of a GPX file's tracks the one so called (`TrackOptions`)
};
inline constexpr double kTrajectoryGap_s = 2;  ///< a bend of a walk takes longer
inline constexpr double kTrackGap_s = 20;      ///< receivers leave out points on the straight

/// Poses and distances of a walk's frames from `truth.csv`. Throws `vo::Error` if it has not one row for each
/// frame.
Survey survey_from_truth(const std::filesystem::path& path, const vo::Walk& walk);

/// The same from a trajectory (`vo::read_pose_series`). Frames outside it or in its gaps have no pose; the
/// distance is the length of the path between the frames' positions, straight over gaps. Throws `vo::Error`
/// if no frame has a pose, or a file without times has not one for each frame.
Survey survey_from_trajectory(const std::filesystem::path& path, const vo::Walk& walk,
                              const SurveyOptions& options = {});

/// The same from a GPS track (`read_track`), with no pose between its segments. Poses are metres about the
/// origin, which becomes the track's first point if there is none.
Survey survey_from_track(const std::filesystem::path& path, const vo::Walk& walk,
                         std::optional<GeographicOrigin>& origin, const SurveyOptions& options = {});

/// The same for a traverse of `route`, whose origin it takes or gives. Throws `vo::Error` if the route has
/// surveyed poses that are not geographic: metres about an origin would not fit them.
Survey survey_from_track(const std::filesystem::path& path, const vo::Walk& walk, Route& route,
                         const SurveyOptions& options = {});

/// For a walk that nobody surveyed: the poses of its odometry, one for each frame, without distances. None if
/// there is no odometry.
std::optional<Survey> survey_from_odometry(const vo::Trajectory& odometry);

}  // namespace place
