#pragma once

#include "walk_pictures.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <place/route/route.hpp>
#include <place/settings.hpp>
#include <vo/geometry/camera.hpp>

namespace retrace {

/// Files by the name of the traverse that they are recordings of.
using TraverseFiles = std::map<std::string, std::vector<std::string>>;

/// Sorts the files of `--reference`: FILE for a route of one traverse, else NAME=FILE. Throws `vo::Error` for
/// a traverse that the route does not have, or FILE where it has several.
TraverseFiles traverse_files(const std::vector<std::string>& given, const place::Route& route);

/// How a recording was read, from the resolved settings of its walk: its rate and the part of its pictures.
vo::FrameSourceOptions reading_of(const place::Settings& settings);

/// The camera of a walk: its calibration, or that of its field of view, 64.4 degrees if not known. Throws
/// `vo::Error` if the calibration cannot be read or does not fit pictures of this size.
vo::Camera camera_of(const place::Settings& settings, int width_px, int height_px);

/// The recording of a traverse, if it still has its name and lies in the working folder or beside the route;
/// a file of that name with pictures of another size, or of another length, is another recording.
std::optional<Recording> recording_near(const std::filesystem::path& route, const place::Traverse& traverse);

/// `camera_of` a traverse, its calibration read from the working folder or beside the route. Throws
/// `vo::Error` if it is in neither.
vo::Camera camera_near(const std::filesystem::path& route, const place::Traverse& traverse);

}  // namespace retrace
