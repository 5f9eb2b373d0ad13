#pragma once

#include "vo/geometry/camera.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// The interest points of one view in the form in which they are kept of a keyframe: where each is seen, by
/// angles, so that any lens and any field of view fit, and what its neighbourhood looks like.
struct ViewPoints {
  static constexpr std::size_t kValues = 64;  ///< of a descriptor

  std::vector<float> azimuth_rad;        ///< to the right of the camera's axis, in (-pi/2, pi/2)
  std::vector<float> elevation_rad;      ///< below the camera's horizontal plane, in (-pi/2, pi/2)
  std::vector<float> log2_size;          ///< logarithm of the point's scale, an angle in radians
  std::vector<std::int8_t> laplacian;    ///< +1 dark blob on light, -1 light on dark
  std::vector<std::int8_t> descriptors;  ///< kValues a point, whose squares sum to about 2,500 on average

  [[nodiscard]] std::size_t size() const { return azimuth_rad.size(); }
  [[nodiscard]] std::span<const std::int8_t> descriptor(std::size_t i) const {
    return {descriptors.data() + i * kValues, kValues};
  }
};

/// The camera through which a view is seen: calibrated, or known by its horizontal field of view
/// (`camera_of_recording`).
struct ViewCamera {
  double fov_deg = 64.4;
  std::optional<Camera> calibrated;
};

/// At most so many points are kept of a view, in so many bytes each: two for either angle, one for size and
/// laplacian, and 4 bits for each value of the descriptor.
inline constexpr std::size_t kMostViewPoints = 200;
inline constexpr std::size_t kViewPointBytes = 37;

/// The strongest SURF points of a picture (`detect_surf`; upright, as a walker's camera is, which matches
/// more of them), the strongest first, packed: at most 7.4 kB. Pictures wider than 640 pixels are resized to
/// that.
///
/// Descriptor values are companded: the sign and seven steps of the square root, so that small values, of
/// which there are most, have the smaller steps. The angles are kept in steps of 5e-5 rad, a fortieth of a
/// pixel.
///
/// `picture`: 8 bit, grey or BGR. Throws `std::invalid_argument` if it is not so or empty, `Error` for a
/// calibrated camera of another shape. A constant picture gives no bytes. About 2 ms for 640x360.
std::vector<std::uint8_t> pack_view_points(const cv::Mat& picture, const ViewCamera& camera);

/// The points again. Throws `Error` for bytes that are no such points.
ViewPoints unpack_view_points(std::span<const std::uint8_t> packed);

}  // namespace vo
