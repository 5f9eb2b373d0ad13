#include "vo/tracks/view_points.hpp"

#include "vo/base/error.hpp"
#include "vo/image/grey.hpp"
#include "vo/surf/surf.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace vo {
namespace {

constexpr int kWidth_px = 640;  // that of tracking [PVO 5.1]
constexpr double kAngleStep_rad = std::numbers::pi / 65536;
constexpr int kMostSteps = 7;           // of a companded value to either side
constexpr float kLargestValue = 0.75F;  // of a descriptor of unit length; what is beyond is cut
constexpr int kSizesPerOctave = 8, kSizeOctaves = 14;  // sizes from 2^-14 rad on, in 7 bits
constexpr int kMostSize = 127;

SurfOptions surf_options() {
  SurfOptions options;
  options.detector.max_points = kMostViewPoints;
  options.upright = true;
  return options;
}

int companded(float value) {
  const float steps = std::round(std::sqrt(std::abs(value) / kLargestValue) * kMostSteps);
  const int whole = std::min(static_cast<int>(steps), kMostSteps);
  return value < 0 ? -whole : whole;
}

void put(std::vector<std::uint8_t>& bytes, double angle_rad) {
  constexpr double kMost = 32767;
  const auto steps =
      static_cast<std::int16_t>(std::clamp(std::round(angle_rad / kAngleStep_rad), -kMost, kMost));
  const auto bits = std::bit_cast<std::uint16_t>(steps);
  bytes.push_back(static_cast<std::uint8_t>(bits & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>(bits >> 8U));
}

float angle_at(std::span<const std::uint8_t> bytes) {
  const auto bits = static_cast<std::uint16_t>(bytes[0] | (bytes[1] << 8U));
  return static_cast<float>(std::bit_cast<std::int16_t>(bits) * kAngleStep_rad);
}

}  // namespace

std::vector<std::uint8_t> pack_view_points(const cv::Mat& picture, const ViewCamera& view) {
  if (picture.empty()) throw std::invalid_argument("pack_view_points: a picture expected");
  Camera camera = camera_of_recording(view.calibrated, picture.cols, picture.rows, view.fov_deg);
  if (picture.cols > kWidth_px) camera = resized(camera, kWidth_px);
  const Features features = detect_surf(grey_of(picture, kWidth_px), surf_options());
  std::vector<ImagePoint> pixels;
  for (const Feature& point : features.points) pixels.push_back({point.x_px, point.y_px});
  const std::vector<ImagePoint> rays = undistort(camera, pixels);

  std::vector<std::uint8_t> packed;
  packed.reserve(features.size() * kViewPointBytes);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Feature& point = features.points[i];
    put(packed, std::atan(rays[i].x));
    put(packed, std::atan2(rays[i].y, std::hypot(rays[i].x, 1)));
    const double octaves = std::log2(point.scale_px / camera.fx_px) + kSizeOctaves;
    const int size = std::clamp(static_cast<int>(std::lround(octaves * kSizesPerOctave)), 0, kMostSize);
    packed.push_back(static_cast<std::uint8_t>(size | (point.laplacian < 0 ? 0x80 : 0)));
    const std::span<const float> values = features.descriptor(i);
    for (std::size_t v = 0; v < values.size(); v += 2) {
      const int low = companded(values[v]) + kMostSteps, high = companded(values[v + 1]) + kMostSteps;
      packed.push_back(static_cast<std::uint8_t>(low | (high << 4)));
    }
  }
  return packed;
}

ViewPoints unpack_view_points(std::span<const std::uint8_t> packed) {
  const std::size_t count = packed.size() / kViewPointBytes;
  if (packed.size() % kViewPointBytes != 0 || count > kMostViewPoints) {
    throw Error("the points of a view", fmt::format("are {} bytes", packed.size()),
                fmt::format("{} for each of at most {} points", kViewPointBytes, kMostViewPoints));
  }
  ViewPoints points;
  points.descriptors.reserve(count * ViewPoints::kValues);
  const auto value_of = [](int nibble) {
    const int steps = nibble - kMostSteps;
    return static_cast<std::int8_t>(steps * std::abs(steps));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const auto bytes = packed.subspan(i * kViewPointBytes, kViewPointBytes);
    points.azimuth_rad.push_back(angle_at(bytes));
    points.elevation_rad.push_back(angle_at(bytes.subspan(2)));
    const int size = bytes[4] & 0x7F;
    points.log2_size.push_back(static_cast<float>(size) / kSizesPerOctave - kSizeOctaves);
    points.laplacian.push_back((bytes[4] & 0x80) != 0 ? std::int8_t{-1} : std::int8_t{1});
    for (const std::uint8_t pair : bytes.subspan(5)) {
      points.descriptors.push_back(value_of(pair & 0x0F));
      points.descriptors.push_back(value_of(pair >> 4));
    }
  }
  return points;
}

}  // namespace vo
