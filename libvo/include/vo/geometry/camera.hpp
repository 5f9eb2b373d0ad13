#pragma once

#include <optional>
#include <vector>

namespace vo {

/// How a lens bends rays.
enum class LensModel {
  kOpenCv,       ///< a pinhole with radial and tangential distortion [OpenCV, module calib3d]
  kEquidistant,  ///< a fisheye: radius theta (1 + k1 theta^2 + ... + k4 theta^8), theta the ray's angle off
                 ///< the axis [Kannala, Brandt: A generic camera model ..., 2006; cv::fisheye]
};

/// A camera. Pixel (0, 0) is the centre of the upper left pixel.
struct Camera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;  ///< focal lengths
  double fy_px = 0;
  double cx_px = 0;  ///< principal point
  double cy_px = 0;
  std::vector<double> distortion;  ///< k1 k2 p1 p2 [k3 [k4 k5 k6 ...]], a fisheye's k1 k2 k3 k4; empty: none
  LensModel lens = LensModel::kOpenCv;
};

/// The undistorted camera with a given horizontal field of view, square pixels and central principal point
/// (PVO 5.3(6)). Throws `std::invalid_argument` unless the size is positive and the angle in [10, 170]
/// degrees.
Camera camera_from_fov(int width_px, int height_px, double fov_deg);

/// The calibrated camera, scaled to the recording's size; without one, the camera of the field of view. The
/// recording must have the calibration's aspect ratio, to a pixel. A calibration without a size (0x0) is
/// assumed to have the recording's, whose middle must then be near the principal point. Throws `vo::Error`
/// otherwise.
Camera camera_of_recording(const std::optional<Camera>& calibrated, int width_px, int height_px,
                           double fov_deg);

/// The same camera with images resized to `width_px` columns.
Camera resized(const Camera& camera, int width_px);

/// A point on the image plane at depth 1: x right, y down, undistorted.
struct ImagePoint {
  double x = 0;
  double y = 0;
};

/// The image-plane points of pixels. O(points).
std::vector<ImagePoint> undistort(const Camera& camera, const std::vector<ImagePoint>& pixels);

/// Where a point of the image plane is seen through a lens with radial distortion: (1 + radial r^2) times it.
ImagePoint with_radial(const ImagePoint& at, double radial);

/// The inverse of `with_radial`; for |radial| r^2 up to a tenth.
ImagePoint without_radial(const ImagePoint& seen, double radial);

}  // namespace vo
