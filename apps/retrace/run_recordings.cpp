#include "run_recordings.hpp"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include <place/stage_options.hpp>
#include <vo/base/error.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

/// Files and folders of this name in the working folder and beside a route, whatever folder the route says: a
/// path is not opened because it stands in a database.
std::vector<fs::path> files_near(const fs::path& route, const fs::path& named) {
  std::vector<fs::path> files;
  const fs::path name = named.filename();
  if (name.empty() || name == "." || name == "..") return files;
  for (const fs::path& folder : {fs::path(), route.parent_path()}) {
    const fs::path file = folder / name;
    if (fs::is_regular_file(file) || fs::is_directory(file)) files.push_back(file);
  }
  return files;
}

bool is_it(const Recording& recording, const place::Traverse& traverse) {
  try {
    const auto source = vo::open_frame_source(recording.files, recording.options);
    const std::optional<std::int64_t> frames = source->expected_frames();
    const std::optional<vo::Frame> first = source->next();
    constexpr std::int64_t kSlack = 2;  // frames by which a container may count otherwise
    return first && first->image.cols == traverse.frame_width_px &&
           first->image.rows == traverse.frame_height_px &&
           (!frames || std::abs(*frames - traverse.frames) <= kSlack);
  } catch (const vo::Error&) {
    return false;
  }
}

}  // namespace

TraverseFiles traverse_files(const std::vector<std::string>& given, const place::Route& route) {
  TraverseFiles files;
  for (const std::string& argument : given) {
    if (route.traverses.size() == 1) {
      files[route.traverses[0].name].push_back(argument);
      continue;
    }
    const place::Traverse* named = nullptr;  // of the longest name, which may hold an equals sign itself
    for (const place::Traverse& traverse : route.traverses)
      if (argument.starts_with(traverse.name + "=") &&
          (named == nullptr || traverse.name.size() > named->name.size()))
        named = &traverse;
    if (named == nullptr) {
      std::string names;
      for (const place::Traverse& traverse : route.traverses)
        names += (names.empty() ? "" : ", ") + traverse.name;
      throw vo::Error("--reference", fmt::format("'{}' does not name a traverse", argument),
                      "NAME=FILE, NAME being one of " + names);
    }
    files[named->name].push_back(argument.substr(named->name.size() + 1));
  }
  return files;
}

vo::FrameSourceOptions reading_of(const place::Settings& settings) {
  place::Settings reading;
  reading.frame_rate_hz = settings.frame_rate_hz;
  reading.exif_times = settings.exif_times;
  reading.crop = settings.crop;
  return place::stage_options(reading).walk.frames;
}

vo::Camera camera_of(const place::Settings& settings, int width_px, int height_px) {
  place::Settings camera;
  camera.fov_deg = settings.fov_deg;
  camera.camera = settings.camera;
  const vo::FeatureTrackerOptions tracker = place::stage_options(camera).walk.tracker;
  return vo::camera_of_recording(tracker.camera, width_px, height_px, tracker.fov_deg);
}

std::optional<Recording> recording_near(const fs::path& route, const place::Traverse& traverse) {
  for (const fs::path& file : files_near(route, traverse.source)) {
    Recording recording{{file.string()}, reading_of(traverse.settings), traverse.frames};
    if (is_it(recording, traverse)) return recording;
  }
  return std::nullopt;
}

vo::Camera camera_near(const fs::path& route, const place::Traverse& traverse) {
  place::Settings settings = traverse.settings;
  if (settings.camera) {
    const std::vector<fs::path> files = files_near(route, *settings.camera);
    if (files.empty())
      throw vo::Error(*settings.camera, fmt::format("is not beside {}", route.string()),
                      "the calibration of the reference's camera there, or in the working folder");
    settings.camera = files.front().string();
  }
  return camera_of(settings, traverse.frame_width_px, traverse.frame_height_px);
}

}  // namespace retrace
