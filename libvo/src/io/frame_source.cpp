#include "vo/io/frame_source.hpp"

#include "io/frame_sources.hpp"
#include "vo/base/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

namespace vo {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWalkForms =
    "a video file, a folder of images, camera:N, rtsp://..., or - (Y4M on standard input)";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::optional<int> camera_number(std::string_view walk) {
  constexpr std::string_view kPrefix = "camera:";
  if (!walk.starts_with(kPrefix)) return std::nullopt;
  const std::string_view digits = walk.substr(kPrefix.size());
  int number = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size() || number < 0) {
    throw Error(walk, "is no camera", "camera:N with N = 0, 1, ...");
  }
  return number;
}

void check(const FrameSourceOptions& options) {
  const auto is_rate = [](double rate_hz) { return rate_hz > 0 && std::isfinite(rate_hz); };
  if (options.frame_rate_hz && !is_rate(*options.frame_rate_hz))
    throw std::invalid_argument("open_frame_source: frame_rate_hz must be positive and finite");
  if (options.colour_width_px < 0)
    throw std::invalid_argument("open_frame_source: colour_width_px must be >= 0");
}

std::unique_ptr<SampledSource> open_as_it_is(const std::string& walk, const FrameSourceOptions& options) {
  std::error_code none;
  if (options.exif_times && !fs::is_directory(walk, none))
    throw Error(walk, "is no folder of images, whose EXIF data --exif-times reads", "no exif-times");
  if (options.exif_times && options.frame_rate_hz)
    throw Error("--exif-times", "and --frame-rate-hz are both given", "one of them: each sets the times");
  if (const std::optional<int> number = camera_number(walk)) {
    if (options.frame_rate_hz)
      throw Error(walk, "has times of its own, those of arrival", "no frame-rate-hz for a camera");
    return open_camera(*number);
  }
  if (is_live(walk)) return open_video(walk, options);
  std::error_code error;
  const fs::file_status status = fs::status(walk, error);
  if (status.type() == fs::file_type::not_found) throw Error(walk, "does not exist", kWalkForms);
  if (error) throw Error(walk, error.message(), kWalkForms);
  if (fs::is_directory(status)) return open_folder(walk, options);
  if (fs::is_regular_file(status) && fs::file_size(walk, error) == 0 && !error)
    throw Error(walk, "is empty (0 bytes)", kWalkForms);
  return open_video(walk, options);
}

}  // namespace

bool is_live(std::string_view walk) {
  return walk == "-" || walk.starts_with("camera:") || walk.starts_with("rtsp://") ||
         walk.starts_with("rtsps://");
}

bool natural_less(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  const auto take_number = [](std::string_view& text) {
    std::size_t length = 0;
    while (length < text.size() && is_digit(text[length])) ++length;
    std::string_view digits = text.substr(0, length);
    text.remove_prefix(length);
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
  };
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view number_a = take_number(a);
      const std::string_view number_b = take_number(b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
    } else {
      if (a.front() != b.front())
        return static_cast<unsigned char>(a.front()) < static_cast<unsigned char>(b.front());
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // the same but for leading zeros
}

std::unique_ptr<FrameSource> open_frame_source(const std::string& walk, const FrameSourceOptions& options) {
  check(options);
  return prepared(open_as_it_is(walk, options), walk == "-" ? "standard input" : walk, options);
}

std::unique_ptr<FrameSource> open_frame_source(std::span<const std::string> walks,
                                               const FrameSourceOptions& options) {
  if (walks.empty()) throw std::invalid_argument("open_frame_source: a walk expected");
  if (walks.size() == 1) return open_frame_source(walks[0], options);
  for (const std::string& walk : walks) {
    if (is_live(walk))
      throw Error(walk, "cannot be one of several", "video files or folders of images, in order");
  }
  return chained(walks, options);
}

}  // namespace vo
