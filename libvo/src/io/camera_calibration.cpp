#include "vo/io/camera_calibration.hpp"

#include "io/flat_yaml.hpp"
#include "vo/base/error.hpp"
#include "vo/io/text_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vo {
namespace {

constexpr std::string_view kForm =
    "a camera calibration of OpenCV, ROS, Kalibr or ORB-SLAM (image_width, image_height, camera_matrix, ...)";

/// A calibration as it stands in a file, whoever wrote it.
struct Calibration {
  double width = 0, height = 0;              ///< 0: not said
  std::array<double, 4> focal_and_centre{};  ///< fx fy cx cy
  std::string model;                         ///< of camera and distortion, in the writer's words
  std::vector<double> distortion;
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

/// A key as all spell it: `cameraMatrix`, `Camera_Matrix`, `camera_matrix`.
std::string plain_key(std::string_view key) {
  std::string plain = lower(key);
  std::erase(plain, '_');
  return plain;
}

/// The values of a file, by keys however they are spelt.
class Reader {
 public:
  Reader(const std::filesystem::path& path, const FlatYaml& values) : path_(path.string()) {
    for (const auto& [key, value] : values) values_.emplace(plain_key(key), value);
  }

  [[nodiscard]] bool has(std::string_view key) const { return values_.contains(plain_key(key)); }

  [[nodiscard]] std::string text(const std::string& key) const {
    const auto found = values_.find(plain_key(key));
    return found == values_.end() ? std::string() : found->second;
  }

  [[nodiscard]] std::vector<double> numbers(const std::string& key) const {
    const auto numbers = numbers_of(text(key));
    if (!numbers) throw Error(path_, fmt::format("{} is '{}'", key, printable(text(key))), "numbers");
    return *numbers;
  }

  [[nodiscard]] std::optional<double> number(const std::string& key) const {
    const std::vector<double> all = has(key) ? numbers(key) : std::vector<double>();
    return all.size() == 1 ? std::optional(all[0]) : std::nullopt;
  }

 private:
  std::string path_;
  FlatYaml values_;
};

/// The first of the keys that the file has, or the last.
std::string first_of(const Reader& file, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (file.has(key)) return key;
  return std::data(keys)[keys.size() - 1];
}

/// Kalibr's, its keys after `camera`; EuRoC's `sensor.yaml` has the same without one.
Calibration kalibr(const Reader& file, const std::string& path, const std::string& camera) {
  Calibration c;
  const std::vector<double> size = file.numbers(camera + "resolution");
  const std::vector<double> intrinsics = file.numbers(camera + "intrinsics");
  const std::string projection = lower(file.text(camera + "camera_model"));
  c.model = projection == "pinhole" ? lower(file.text(camera + "distortion_model")) : projection;
  if (projection == "pinhole" && intrinsics.size() != 4)
    throw Error(path, fmt::format("has {} intrinsics", intrinsics.size()), "4: fx fy cx cy");
  if (projection == "pinhole") std::ranges::copy(intrinsics, c.focal_and_centre.begin());
  if (size.size() == 2) {
    c.width = size[0];
    c.height = size[1];
  }
  c.distortion = file.numbers(
      camera + (file.has("distortion_coefficients") ? "distortion_coefficients" : "distortion_coeffs"));
  return c;
}

Calibration orb_slam(const Reader& file, const std::string& path, const std::string& camera) {
  Calibration c{.model = lower(file.text("Camera.type"))};
  constexpr std::array kNames{"fx", "fy", "cx", "cy"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto value = file.number(fmt::format("{}.{}", camera, kNames[i]));
    if (!value) throw Error(path, fmt::format("has no {}.{}", camera, kNames[i]), kForm);
    c.focal_and_centre[i] = *value;
  }
  c.width = file.number("Camera.width").value_or(0);
  c.height = file.number("Camera.height").value_or(0);
  const bool fisheye = c.model == "kannalabrandt8";
  for (const char* name :
       fisheye ? std::array{"k1", "k2", "k3", "k4", ""} : std::array{"k1", "k2", "p1", "p2", "k3"}) {
    const auto value = file.number(fmt::format("{}.{}", camera, name));
    if (value) c.distortion.push_back(*value);
  }
  if (c.model == "rectified") c.distortion.clear();
  return c;
}

Calibration opencv_or_ros(const Reader& file, const std::string& path) {
  Calibration c;
  c.width = file.number(first_of(file, {"image_width", "width"})).value_or(0);
  c.height = file.number(first_of(file, {"image_height", "height"})).value_or(0);
  if ((c.width < 1) != (c.height < 1))
    throw Error(path, "has one of image_width and image_height", "both, or neither");
  const std::vector<double> k =
      file.numbers(first_of(file, {"camera_matrix.data", "camera_matrix", "K.data", "K"}));
  if (k.size() != 9) throw Error(path, "has no 3x3 camera_matrix", kForm);
  c.focal_and_centre = {k[0], k[4], k[2], k[5]};
  c.model = lower(file.text("distortion_model"));
  if (const std::string camera_model = lower(file.text(first_of(file, {"camera_model", "model_type"})));
      !camera_model.empty() && camera_model != "pinhole")
    c.model = camera_model;
  if (file.number("fisheye_model").value_or(0) != 0) c.model = "fisheye";
  c.distortion =
      file.numbers(first_of(file, {"distortion_coefficients.data", "distortion_coefficients",
                                   "dist_coeffs.data", "dist_coeffs", "dist_coeff.data", "dist_coeff", "D"}));
  return c;
}

constexpr std::size_t kMostKeys = 1000;  // of a file; as many as `read_flat_yaml` reads

/// OpenCV's XML as if it were YAML. Not by OpenCV, whose reader runs past the end of what is no XML, and
/// takes the memory that a matrix says it has.
FlatYaml read_xml(const std::string& path, const std::vector<char>& text) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  const pugi::xml_node root = document.child("opencv_storage");
  if (!parsed || !root) throw Error(path, "is no XML that OpenCV writes", kForm);
  const auto in_a_line = [](std::string value) {
    std::ranges::replace_if(
        value, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return value;
  };
  FlatYaml values;
  for (const pugi::xml_node& node : root) {
    if (values.size() >= kMostKeys) break;
    const pugi::xml_node data = node.child("data");
    values[data ? fmt::format("{}.data", node.name()) : node.name()] =
        in_a_line(data ? data.child_value() : node.child_value());
  }
  return values;
}

/// The same of its JSON.
FlatYaml read_json(const std::string& path, const std::vector<char>& text) {
  using nlohmann::json;
  constexpr int kDeepest = 4;
  const auto shallow = [](int depth, json::parse_event_t, json&) { return depth <= kDeepest; };
  const json all = json::parse(text.begin(), text.end(), shallow, false);
  if (!all.is_object()) throw Error(path, "is no JSON that OpenCV writes", kForm);
  FlatYaml values;
  for (const auto& [key, value] : all.items()) {
    if (values.size() >= kMostKeys) break;
    if (value.is_number()) values[key] = fmt::format("{}", value.get<double>());
    if (value.is_string()) values[key] = value.get<std::string>();
    const auto data = value.is_object() ? value.find("data") : value.end();
    if (!value.is_object() || data == value.end() || !data->is_array()) continue;
    std::string& list = values[key + ".data"];
    for (const json& number : *data)
      if (number.is_number()) list += fmt::format("{}{}", list.empty() ? "" : ", ", number.get<double>());
  }
  return values;
}

FlatYaml values_of(const std::filesystem::path& path) {
  constexpr std::uintmax_t kLongest = 1U << 20U;  // bytes; real ones have a few thousand
  std::error_code ignored;
  if (const auto bytes = std::filesystem::file_size(path, ignored); !ignored && bytes > kLongest)
    throw Error(path.string(), fmt::format("is {} bytes long", bytes), kForm);
  const TextFile file = read_text_file(path, kForm);
  const auto first =
      std::ranges::find_if(file.lines, [](const TextLine& line) { return !trimmed(line.text).empty(); });
  const char begin = first == file.lines.end() ? '\0' : trimmed(first->text)[0];
  if (begin == '<') return read_xml(path.string(), file.bytes);
  if (begin == '{') return read_json(path.string(), file.bytes);
  FlatYaml values = read_flat_yaml(file.lines);
  if (values.empty()) throw Error(path.string(), "is no YAML, XML or JSON", kForm);
  return values;
}

LensModel lens_of(const std::string& path, const std::string& model) {
  for (const char* known : {"", "none", "pinhole", "rectified", "plumb_bob", "rational_polynomial", "radtan",
                            "radial-tangential"})
    if (model == known) return LensModel::kOpenCv;
  for (const char* known : {"equidistant", "fisheye", "kannalabrandt8"})
    if (model == known) return LensModel::kEquidistant;
  throw Error(path, fmt::format("is of the camera model '{}'", printable(model)),
              "a pinhole camera with OpenCV's distortion, or an equidistant fisheye");
}

}  // namespace

Camera read_camera_calibration(const std::filesystem::path& path) {
  const std::string name = path.string();
  const Reader file(path, values_of(path));
  Calibration c;
  if (file.has("cam0.camera_model")) {
    c = kalibr(file, name, "cam0.");
  } else if (file.has("intrinsics") && file.has("resolution")) {
    c = kalibr(file, name, "");
  } else if (file.has("Camera.fx") || file.has("Camera.type")) {
    c = orb_slam(file, name, file.has("Camera.fx") ? "Camera" : "Camera1");
  } else if (file.has("Camera1.fx")) {
    c = orb_slam(file, name, "Camera1");
  } else {
    c = opencv_or_ros(file, name);
  }
  Camera camera{.lens = lens_of(name, c.model)};
  constexpr double kLargestSide = 1 << 20;  // px
  if (!(c.width >= 0 && c.height >= 0 && c.width <= kLargestSide && c.height <= kLargestSide))
    throw Error(name, fmt::format("is of pictures of {:g}x{:g} pixels", c.width, c.height), "their size");
  camera.width_px = static_cast<int>(std::lround(c.width));
  camera.height_px = static_cast<int>(std::lround(c.height));
  camera.fx_px = c.focal_and_centre[0];
  camera.fy_px = c.focal_and_centre[1];
  camera.cx_px = c.focal_and_centre[2];
  camera.cy_px = c.focal_and_centre[3];
  if (!(camera.fx_px > 0) || !(camera.fy_px > 0)) {
    throw Error(name, fmt::format("has focal lengths {} and {}", camera.fx_px, camera.fy_px),
                "pixels, above 0");
  }
  constexpr std::array<std::size_t, 6> kCounts{0, 4, 5, 8, 12, 14};
  const bool fisheye = camera.lens == LensModel::kEquidistant;
  if (fisheye ? c.distortion.size() != 4 : std::ranges::find(kCounts, c.distortion.size()) == kCounts.end()) {
    throw Error(name, fmt::format("has {} distortion_coefficients", c.distortion.size()),
                fisheye ? "4, of a fisheye" : "0, 4, 5, 8, 12 or 14");
  }
  if (std::ranges::any_of(c.distortion, [](double k) { return k != 0; }) || fisheye)
    camera.distortion = std::move(c.distortion);
  return camera;
}

}  // namespace vo
