#include "side_video_input.hpp"

#include "report/run_data.hpp"
#include "run_recordings.hpp"
#include "settings_file.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

/// What was travelled at each frame of the query; empty without motion.
std::vector<double> travelled_of(const fs::path& folder, std::size_t frames) {
  const nlohmann::ordered_json data = read_run_data(folder);
  std::vector<double> travelled;
  if (!data.contains("query") || !data["query"].contains("displacement")) return travelled;
  for (const auto& value : data["query"]["displacement"])
    if (value.is_number()) travelled.push_back(value.get<double>());
  return travelled.size() == frames ? travelled : std::vector<double>();
}

ShownTraverse shown(const place::Traverse& traverse, const std::vector<std::string>& files,
                    const std::string& route, int width_px) {
  ShownTraverse result;
  std::optional<Recording> recording;
  if (!files.empty()) {
    recording = Recording{files, reading_of(traverse.settings), traverse.frames};
  } else {
    recording = recording_near(route, traverse);
  }
  result.previews = !recording;
  if (recording) {
    result.pictures = recorded_pictures(*recording, width_px);
    return result;
  }
  result.pictures = preview_pictures(traverse);
  if (!result.pictures)
    throw vo::Error(route, fmt::format("has no pictures of '{}'", traverse.name),
                    fmt::format("--reference FILE, the recording {}", traverse.source));
  spdlog::warn(
      "{} is not beside {}: small pictures of keyframes are shown; --reference FILE says where it is",
      traverse.source, route);
  return result;
}

}  // namespace

SideVideo side_video_of(const SideVideoInput& input, const place::Route& route,
                        const std::vector<place::Match>& matches, const RunSummary& summary) {
  const place::Settings settings = read_settings_file((fs::path(input.folder) / "config.toml").string());
  const std::vector<double> travelled = travelled_of(input.folder, summary.query_frames);
  SideVideo video{.route = route,
                  .matches = matches,
                  .timeline = place::reference_timeline(route, matches, summary.query_frames, travelled,
                                                        gaps_of(summary, matches)),
                  .query = {},
                  .query_camera = {},
                  .traverses = {},
                  .width_px = input.width_px,
                  .blink = input.blink};
  const std::vector<std::string> query = input.query.empty() ? std::vector{summary.query} : input.query;
  if (input.query.empty() && !fs::exists(summary.query))
    throw vo::Error(summary.query, "does not exist", "--query FILE, the recording of the run's walk");
  video.query = recorded_pictures(
      {query, reading_of(settings), static_cast<std::int64_t>(summary.query_frames)}, input.width_px);
  const TraverseFiles files = traverse_files(input.reference, route);
  const bool turns =
      std::ranges::any_of(matches, [](const auto& match) { return match.yaw_rad.has_value(); });
  if (input.warp && !turns)
    throw vo::Error("--warp", "has no effect",
                    "a run of `localise --verify 7`, which finds the camera's yaw");
  const cv::Mat first = video.query->at(0).image;
  if (turns && (input.warp || input.blink)) video.query_camera = camera_of(settings, first.cols, first.rows);
  for (const place::Traverse& traverse : route.traverses) {
    const bool used = std::ranges::any_of(matches, [&](const place::Match& match) {
      return match.accepted && match.place->traverse == traverse.name;
    });
    const auto given = files.find(traverse.name);
    ShownTraverse& side = video.traverses.emplace_back();
    if (!used) continue;
    side = shown(traverse, given == files.end() ? std::vector<std::string>() : given->second, input.route,
                 input.width_px);
    if (video.query_camera) side.camera = camera_near(input.route, traverse);
  }
  return video;
}

}  // namespace retrace
