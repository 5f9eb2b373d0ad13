#include "survey_files.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include <place/stage_options.hpp>
#include <vo/base/error.hpp>

namespace retrace {
namespace {

/// Where the track is: of `--track video` and `--track pictures`, in the walk itself.
std::string track_file(const std::string& track, const vo::Walk& walk) {
  if (track != "video" && track != "pictures") return track;
  std::error_code ignored;
  const bool video = track == "video";
  if (!(video ? std::filesystem::is_regular_file(walk.source, ignored)
              : std::filesystem::is_directory(walk.source, ignored)))
    throw vo::Error("--track " + track, fmt::format("is given for {}", walk.source),
                    video ? "a walk of one video file" : "a walk of one folder of pictures");
  return walk.source;
}

}  // namespace

void declare_survey(Arguments& arguments, SurveyFiles& files) {
  const Argument truth =
      arguments.option("--truth", files.truth, "truth.csv of the walk: position and distance of every frame");
  Argument trajectory =
      arguments.option("--trajectory", files.trajectory,
                       "surveyed poses of the walk, TUM format, seconds since its first frame");
  Argument track = arguments.option(
      "--track", files.track,
      "GPS track of the walk: .gpx; .csv with time_s since the first frame, lat_deg, lon_deg; a GoPro's "
      "video; `video` or `pictures` for that in the walk's own file, or in its pictures' EXIF data");
  track.excludes(truth).excludes(trajectory.excludes(truth));
  arguments.rare(
      arguments
          .option(
              "--trajectory-start-s", files.trajectory_start_s,
              "seconds that the trajectory's clock shows at the first frame [0, or by the video's creation "
              "time]")
          .needs(trajectory));
  arguments.rare(
      arguments
          .option("--track-start-s", files.track_start_s,
                  "seconds from a .gpx file's first point, or of a .csv file's clock, to the first "
                  "frame [0, or by the video's creation time]")
          .needs(track));
  arguments.rare(arguments
                     .option("--track-name", files.track_name,
                             "of several tracks in a .gpx file the one so called, or its number from 1")
                     .needs(track));
}

place::Settings settings_beside(const SurveyFiles& files, place::Settings settings,
                                const std::optional<std::string>& motion_of_route) {
  return place::settings_beside_survey(std::move(settings), !files.trajectory.empty(), !files.track.empty(),
                                       motion_of_route);
}

std::optional<place::Survey> read_survey(const SurveyFiles& files, const place::Settings& settings,
                                         const vo::Walk& walk, place::Route& route) {
  if (!files.truth.empty()) return place::survey_from_truth(files.truth, walk);
  place::SurveyOptions form = place::survey_options(settings);
  if (!files.trajectory.empty()) {
    form.start_s = files.trajectory_start_s;
    return place::survey_from_trajectory(files.trajectory, walk, form);
  }
  if (files.track.empty()) return {};
  form.start_s = files.track_start_s;
  form.track_name = files.track_name;
  return place::survey_from_track(track_file(files.track, walk), walk, route, form);
}

}  // namespace retrace
