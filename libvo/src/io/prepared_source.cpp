#include "io/frame_sources.hpp"
#include "vo/base/error.hpp"
#include "vo/image/black_bars.hpp"
#include "vo/image/picture_mask.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

std::string shown(const cv::Size& size) {
  return fmt::format("{}x{}", size.width, size.height);
}

/// A part of a picture of one size in the same picture of another.
cv::Rect scaled(const cv::Rect& part, const cv::Size& of, const cv::Size& to) {
  const auto at = [](int px, int from, int into) {
    return static_cast<int>(std::lround(static_cast<double>(px) * into / from));
  };
  const int left = at(part.x, of.width, to.width), right = at(part.x + part.width, of.width, to.width);
  const int top = at(part.y, of.height, to.height), bottom = at(part.y + part.height, of.height, to.height);
  return {left, top, std::max(1, right - left), std::max(1, bottom - top)};
}

cv::Mat grey_of(const cv::Mat& image) {
  if (image.channels() == 1) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

/// The mask, brought to the size of the pictures. Throws `Error` if it cannot be read or has another shape.
cv::Mat read_mask(const std::string& file, const cv::Size& size) {
  cv::Mat mask;
  try {
    std::error_code ignored;  // OpenCV prints what is not there
    if (std::filesystem::exists(file, ignored)) mask = cv::imread(file, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    mask.release();
  }
  if (mask.empty())
    throw Error(file, "cannot be read as an image", "a mask: black where pictures are not to count");
  constexpr double kSameShape = 0.02;
  const double ratio =
      static_cast<double>(mask.cols) * size.height / (static_cast<double>(mask.rows) * size.width);
  if (std::abs(ratio - 1) > kSameShape) {
    throw Error(file, fmt::format("is {} pixels", shown(mask.size())),
                fmt::format("the shape of the recording's pictures, {}", shown(size)));
  }
  if (mask.size() != size) cv::resize(mask, mask, size, 0, 0, cv::INTER_NEAREST);
  return mask;
}

class PreparedSource final : public FrameSource {
 public:
  PreparedSource(std::unique_ptr<SampledSource> source, std::string name, const FrameSourceOptions& options)
      : source_(std::move(source)), name_(std::move(name)), options_(options) {}

  std::optional<Frame> next() override {
    std::optional<Frame> frame = source_->next();
    if (!frame) return frame;
    if (!begun_) begin(*frame);
    if (crop_) {
      if (!frame->colour.empty())
        frame->colour = frame->colour(scaled(*crop_, frame->image.size(), frame->colour.size())).clone();
      frame->image = frame->image(*crop_).clone();
    }
    if (mask_) mask_->fill(frame->image);
    return frame;
  }

  [[nodiscard]] std::optional<std::int64_t> expected_frames() const override {
    return source_->expected_frames();
  }
  [[nodiscard]] std::optional<double> start_utc_s() const override { return source_->start_utc_s(); }

  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = source_->warnings();
    if (crop_ && !options_.crop) {
      all.push_back(fmt::format("{}: has black bars; of its pictures the part {},{},{},{} is used (--crop)",
                                name_, crop_->x, crop_->y, crop_->width, crop_->height));
    }
    return all;
  }

 private:
  /// What the first picture, and where need be others, say of all of them.
  void begin(const Frame& first) {
    begun_ = true;
    const cv::Size size = first.image.size();
    if (options_.crop) {
      const cv::Rect all({0, 0}, size), part = *options_.crop & all;
      if (part != *options_.crop || part.empty()) {
        throw Error(name_, fmt::format("has pictures of {} pixels", shown(size)),
                    fmt::format("--crop within them, not {},{},{},{}", options_.crop->x, options_.crop->y,
                                options_.crop->width, options_.crop->height));
      }
      if (part != all) crop_ = part;
    } else if (may_have_black_bars(grey_of(first.image))) {
      crop_ = find_black_bars(source_->sample(kSamples));
    }
    if (options_.mask.empty()) return;
    cv::Mat keep = read_mask(options_.mask, size);
    if (crop_) keep = keep(*crop_);
    constexpr int kKept = 128;
    if (cv::countNonZero(keep >= kKept) == 0)
      throw Error(options_.mask, "is black all over", "white where pictures count");
    mask_.emplace(keep);
  }

  std::unique_ptr<SampledSource> source_;
  std::string name_;
  FrameSourceOptions options_;
  bool begun_ = false;
  std::optional<cv::Rect> crop_;
  std::optional<PictureMask> mask_;
};

}  // namespace

std::unique_ptr<FrameSource> prepared(std::unique_ptr<SampledSource> source, const std::string& name,
                                      const FrameSourceOptions& options) {
  return std::make_unique<PreparedSource>(std::move(source), name, options);
}

}  // namespace vo
