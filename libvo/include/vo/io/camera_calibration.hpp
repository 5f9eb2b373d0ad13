#pragma once

#include "vo/geometry/camera.hpp"

#include <filesystem>

namespace vo {

/// Reads a camera calibration as OpenCV's tools write it (YAML, XML or JSON): `image_width`, `image_height`,
/// `camera_matrix` (3x3) and `distortion_coefficients` (none, or 4, 5, 8, 12 or 14). Throws `vo::Error`
/// naming the file and what it lacks.
Camera read_camera_calibration(const std::filesystem::path& path);

}  // namespace vo
