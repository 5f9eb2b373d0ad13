#pragma once

#include "vo/geometry/camera.hpp"

#include <filesystem>

namespace vo {

/// Reads a camera calibration as programs write it:
///  - OpenCV (YAML, XML or JSON): image_width, image_height, camera_matrix, fisheye_model, and
///    distortion_coefficients (none, or 4, 5, 8, 12 or 14);
///  - ROS: the same with distortion_model plumb_bob, rational_polynomial or equidistant;
///  - a ROS camera_info message: width, height, K, D;
///  - Kalibr: cam0 of a camchain, pinhole with radtan, equidistant or no distortion;
///  - ORB-SLAM: Camera.fx ... (or Camera1.), PinHole, KannalaBrandt8 or Rectified.
/// A file that does not say its size (ORB-SLAM's) gives a camera of 0x0, see `camera_of_recording`. Throws
/// `vo::Error` naming the file and what it lacks, or the camera model that cannot be used (omnidirectional,
/// double sphere, field of view).
Camera read_camera_calibration(const std::filesystem::path& path);

}  // namespace vo
