#include "vo/io/frame_source.hpp"

#include "io/video_decoder.hpp"
#include "vo/base/error.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

namespace vo {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWalkForms = "a video file, a folder of images, or camera:N";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_image_name(const fs::path& path) {
  static constexpr std::array<std::string_view, 9> kExtensions{".png",  ".jpg",  ".jpeg", ".bmp", ".tif",
                                                               ".tiff", ".webp", ".pgm",  ".ppm"};
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::ranges::find(kExtensions, extension) != kExtensions.end();
}

class VideoSource final : public FrameSource {
 public:
  VideoSource(const std::string& path, int colour_width_px)
      : path_(path),
        colour_width_px_(colour_width_px),
        decoder_(path),
        expected_(decoder_.expected_frames()) {
    if (const std::optional<double> rate_hz = decoder_.rate_hz()) nominal_step_s_ = 1 / *rate_hz;
    lookahead_ = read();
    if (!lookahead_) throw Error(path, "holds no frame that can be decoded", "a video");
  }

  std::optional<Frame> next() override {
    std::optional<Frame> frame = std::move(lookahead_);
    lookahead_.reset();
    if (!frame) frame = read();
    return frame;
  }

  [[nodiscard]] std::optional<std::int64_t> expected_frames() const override { return expected_; }

  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all;
    // Containers without an index give an estimate from duration and rate, right to a frame or two.
    constexpr std::int64_t kEstimateSlack = 2;
    if (ended_ && expected_ && count_ + kEstimateSlack < *expected_) {
      all.push_back(fmt::format("{}: breaks off: {} of {} frames could be read", path_, count_, *expected_));
    }
    if (untimed_ > 0) {
      all.push_back(fmt::format("{}: {} frames have no usable time; the nominal rate is used for them", path_,
                                untimed_));
    }
    return all;
  }

 private:
  std::optional<Frame> read() {
    std::optional<VideoDecoder::Picture> picture = decoder_.next(colour_width_px_);
    if (!picture) {
      ended_ = true;
      return std::nullopt;
    }
    if (count_ == 0) {
      origin_s_ = picture->time_s.value_or(0);
    } else if (picture->time_s && *picture->time_s - origin_s_ > last_time_s_) {
      last_time_s_ = *picture->time_s - origin_s_;
    } else {
      last_time_s_ += nominal_step_s_;
      ++untimed_;
    }
    return Frame{.index = count_++,
                 .time_s = last_time_s_,
                 .image = std::move(picture->grey),
                 .colour = std::move(picture->colour)};
  }

  std::string path_;
  int colour_width_px_;
  VideoDecoder decoder_;
  std::optional<std::int64_t> expected_;
  double nominal_step_s_ = 1.0 / 30;
  std::optional<Frame> lookahead_;
  std::int64_t count_ = 0;
  std::int64_t untimed_ = 0;
  double origin_s_ = 0;
  double last_time_s_ = 0;
  bool ended_ = false;
};

class FolderSource final : public FrameSource {
 public:
  FolderSource(const std::string& folder, double rate_hz) : rate_hz_(rate_hz) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      if (entry.is_regular_file() && is_image_name(entry.path())) files_.push_back(entry.path().string());
    }
    if (files_.empty()) throw Error(folder, "holds no image", "png, jpg, bmp, tif, webp, pgm or ppm files");
    std::ranges::sort(files_, natural_less);
  }

  std::optional<Frame> next() override {
    if (next_ == files_.size()) return std::nullopt;
    const std::string& file = files_[next_];
    cv::Mat image;
    try {
      image = cv::imread(file, cv::IMREAD_ANYCOLOR);
    } catch (const cv::Exception&) {
      image.release();
    }
    if (image.empty()) throw Error(file, "cannot be read as an image");
    if (next_ == 0) size_ = image.size();
    if (image.size() != size_) {
      throw Error(
          file, fmt::format("is {}x{} pixels", image.cols, image.rows),
          fmt::format("{}x{} as {}", size_.width, size_.height, fs::path(files_[0]).filename().string()));
    }
    const auto index = static_cast<std::int64_t>(next_++);
    return Frame{.index = index, .time_s = static_cast<double>(index) / rate_hz_, .image = std::move(image)};
  }

  [[nodiscard]] std::optional<std::int64_t> expected_frames() const override {
    return static_cast<std::int64_t>(files_.size());
  }

 private:
  std::vector<std::string> files_;
  double rate_hz_;
  std::size_t next_ = 0;
  cv::Size size_;
};

class CameraSource final : public FrameSource {
 public:
  explicit CameraSource(int number) : name_(fmt::format("camera:{}", number)) {
    bool opened = false;
    try {
      opened = capture_.open(number);
    } catch (const cv::Exception&) {
      opened = false;
    }
    if (!opened) throw Error(name_, "cannot be opened", "a connected camera");
  }

  std::optional<Frame> next() override {
    cv::Mat image;
    if (!capture_.read(image) || image.empty()) return std::nullopt;
    const auto now = std::chrono::steady_clock::now();
    if (count_ == 0) start_ = now;
    // Two frames may arrive within one tick of a coarse clock; times stay strictly increasing.
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    last_time_s_ = count_ == 0 ? 0 : std::max(elapsed_s, std::nextafter(last_time_s_, HUGE_VAL));
    return Frame{.index = count_++, .time_s = last_time_s_, .image = std::move(image)};
  }

 private:
  std::string name_;
  cv::VideoCapture capture_;
  std::chrono::steady_clock::time_point start_;
  double last_time_s_ = 0;
  std::int64_t count_ = 0;
};

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

}  // namespace

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
  if (!(options.image_rate_hz > 0) || !std::isfinite(options.image_rate_hz)) {
    throw std::invalid_argument("open_frame_source: image_rate_hz must be positive and finite");
  }
  if (options.colour_width_px < 0) {
    throw std::invalid_argument("open_frame_source: colour_width_px must be >= 0");
  }
  if (const std::optional<int> number = camera_number(walk)) return std::make_unique<CameraSource>(*number);

  std::error_code error;
  const fs::file_status status = fs::status(walk, error);
  if (status.type() == fs::file_type::not_found) throw Error(walk, "does not exist", kWalkForms);
  if (error) throw Error(walk, error.message(), kWalkForms);
  if (fs::is_directory(status)) return std::make_unique<FolderSource>(walk, options.image_rate_hz);
  if (fs::is_regular_file(status) && fs::file_size(walk, error) == 0 && !error) {
    throw Error(walk, "is empty (0 bytes)", kWalkForms);
  }
  return std::make_unique<VideoSource>(walk, options.colour_width_px);
}

}  // namespace vo
