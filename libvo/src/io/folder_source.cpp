#include "io/frame_sources.hpp"
#include "vo/base/error.hpp"
#include "vo/image/grey_range.hpp"
#include "vo/io/picture_tags.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

namespace fs = std::filesystem;

/// An image's name; hidden files are the system's (`._1.jpg` beside `1.jpg`), not the user's.
bool is_image_name(const fs::path& path) {
  static constexpr std::array<std::string_view, 9> kExtensions{".png",  ".jpg",  ".jpeg", ".bmp", ".tif",
                                                               ".tiff", ".webp", ".pgm",  ".ppm"};
  if (path.filename().string().starts_with('.')) return false;
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::ranges::find(kExtensions, extension) != kExtensions.end();
}

/// Empty for what is no image.
cv::Mat read_image(const std::string& file) {
  try {
    return cv::imread(file, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH);
  } catch (const cv::Exception&) {
    return {};
  }
}

cv::Mat grey_of(const cv::Mat& image) {
  if (image.channels() == 1) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

class FolderSource final : public SampledSource {
 public:
  FolderSource(const std::string& folder, const FrameSourceOptions& options)
      : folder_(folder),
        files_(image_files(folder)),
        rate_hz_(options.frame_rate_hz.value_or(kImageRate_hz)),
        look_ahead_(options.look_ahead) {
    if (!options.exif_times) return;
    std::vector<PictureTags> tags;
    for (const std::string& file : files_) tags.push_back(read_picture_tags(file));
    times_s_ = picture_times_s(files_, tags);
    if (tags.front().utc) start_utc_s_ = tags.front().time_s;
  }

  std::optional<Frame> next() override {
    while (next_ < files_.size()) {
      const std::size_t position = next_++;
      const std::string& file = files_[position];
      cv::Mat image = read_image(file);
      if (image.empty()) {
        leave_out(file);
        continue;
      }
      if (first_.empty()) {
        first_ = fs::path(file).filename().string();
        size_ = image.size();
      }
      if (image.size() != size_) {
        throw Error(file, fmt::format("is {}x{} pixels", image.cols, image.rows),
                    fmt::format("{}x{} as {}", size_.width, size_.height, first_));
      }
      if (!origin_) origin_ = position;
      return Frame{
          .index = count_++, .time_s = time_s(position) - time_s(*origin_), .image = in_8_bits(image)};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<cv::Mat> sample(std::size_t count) const override {
    std::vector<cv::Mat> pictures;
    if (!look_ahead_) return pictures;
    for_some(count, [&](const cv::Mat& image) {
      if (image.size() != size_) return;
      pictures.push_back(
          grey_of(image.depth() == CV_8U ? image : stretched(image, range_.value_or(GreyRange()))));
    });
    return pictures;
  }

  [[nodiscard]] std::optional<std::int64_t> expected_frames() const override {
    return static_cast<std::int64_t>(files_.size());
  }

  [[nodiscard]] std::optional<double> start_utc_s() const override {
    if (!start_utc_s_ || !origin_) return start_utc_s_;
    return *start_utc_s_ + time_s(*origin_);
  }

  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all;
    if (!left_out_.empty()) {
      all.push_back(fmt::format("{}: {} of {} images cannot be read and are left out, the first: {}", folder_,
                                left_out_.size(), files_.size(),
                                fs::path(left_out_.front()).filename().string()));
    }
    if (range_) {
      all.push_back(
          fmt::format("{}: images of more than 8 bits: {:.6g} is taken for black and {:.6g} for white",
                      folder_, range_->black, range_->white));
    }
    return all;
  }

 private:
  /// Of an image since the first file.
  [[nodiscard]] double time_s(std::size_t position) const {
    return times_s_.empty() ? static_cast<double>(position) / rate_hz_ : times_s_[position];
  }

  /// Calls `use` with images from all over the folder, those that can be read.
  template <typename Use>
  void for_some(std::size_t count, const Use& use) const {
    const std::size_t all = std::min(count, files_.size());
    for (std::size_t i = 0; i < all; ++i)
      if (const cv::Mat image = read_image(files_[i * files_.size() / all]); !image.empty()) use(image);
  }

  void leave_out(const std::string& file) {
    left_out_.push_back(file);
    constexpr std::size_t kOneOf = 10;
    if (left_out_.size() * kOneOf > files_.size()) {
      throw Error(left_out_.front(), "cannot be read as an image",
                  fmt::format("images, of which one in {} may be broken; {} of {} are", kOneOf,
                              left_out_.size(), files_.size()));
    }
  }

  cv::Mat in_8_bits(const cv::Mat& image) {
    if (image.depth() == CV_8U) return image;
    if (!range_) {
      std::vector<cv::Mat> deep{thinned(image)};
      for_some(look_ahead_ ? kSamples : 0, [&](const cv::Mat& other) {
        if (other.depth() != CV_8U) deep.push_back(thinned(other));
      });
      range_ = range_of(deep).value_or(GreyRange());
    }
    return stretched(image, *range_);
  }

  std::string folder_;
  std::vector<std::string> files_;
  std::vector<double> times_s_;  ///< of the files by their EXIF data; empty: by the rate
  std::optional<double> start_utc_s_;
  double rate_hz_;
  bool look_ahead_;
  std::size_t next_ = 0;
  std::int64_t count_ = 0;
  std::optional<std::size_t> origin_;  ///< position of the first image that could be read
  std::string first_;                  ///< its name
  cv::Size size_;
  std::vector<std::string> left_out_;
  std::optional<GreyRange> range_;  ///< of deep images
};

}  // namespace

std::vector<std::string> image_files(const std::string& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_image_name(entry.path())) files.push_back(entry.path().string());
  }
  if (files.empty()) throw Error(folder, "holds no image", "png, jpg, bmp, tif, webp, pgm or ppm files");
  std::ranges::sort(files, natural_less);
  return files;
}

std::unique_ptr<SampledSource> open_folder(const std::string& folder, const FrameSourceOptions& options) {
  return std::make_unique<FolderSource>(folder, options);
}

}  // namespace vo
