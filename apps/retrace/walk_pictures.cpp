#include "walk_pictures.hpp"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <optional>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

constexpr std::size_t kKept = 64;  // pictures; 44 MB of 640x360 pixels

/// BGR, no wider than `width_px`.
cv::Mat for_viewing(const vo::Frame& frame, int width_px) {
  cv::Mat picture = frame.colour.empty() ? frame.image : frame.colour;
  if (picture.cols > width_px) {
    const double scale = static_cast<double>(width_px) / picture.cols;
    cv::resize(picture, picture, {}, scale, scale, cv::INTER_AREA);
  }
  if (picture.channels() == 1) cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

class RecordedPictures final : public WalkPictures {
 public:
  RecordedPictures(Recording recording, int width_px)
      : recording_(std::move(recording)), width_px_(width_px) {
    recording_.options.colour_width_px = width_px;
    open();
    const std::optional<std::int64_t> there = source_->expected_frames();
    const std::int64_t slack = 2 + recording_.frames / 50;  // some containers give the duration alone
    if (recording_.frames > 0 && there && std::abs(*there - recording_.frames) > slack) throw other(*there);
  }

  WalkPicture at(std::int64_t frame) override {
    if (frame < next_ - static_cast<std::int64_t>(kept_.size())) open();
    while (next_ <= frame) read();
    return kept_[static_cast<std::size_t>(frame - (next_ - static_cast<std::int64_t>(kept_.size())))];
  }

 private:
  void open() {
    source_ = vo::open_frame_source(recording_.files, recording_.options);
    kept_.clear();
    next_ = 0;
  }

  void read() {
    const std::optional<vo::Frame> frame = source_->next();
    if (!frame) throw other(next_);
    kept_.push_back({for_viewing(*frame, width_px_), frame->time_s});
    ++next_;
    if (kept_.size() > kKept) kept_.pop_front();
    if (next_ == recording_.frames && source_->next()) throw other(next_ + 1);
  }

  /// It is not the recording that was expected.
  [[nodiscard]] vo::Error other(std::int64_t frames) const {
    return {recording_.files.front(),
            fmt::format("has {} frames{}", frames, frames > recording_.frames ? " or more" : ""),
            fmt::format("the walk of the run, with {}", recording_.frames)};
  }

  Recording recording_;
  int width_px_;
  std::unique_ptr<vo::FrameSource> source_;
  std::deque<WalkPicture> kept_;
  std::int64_t next_ = 0;  ///< the frame that is read next
};

class PreviewPictures final : public WalkPictures {
 public:
  explicit PreviewPictures(const place::Traverse& traverse) : traverse_(traverse) {}

  WalkPicture at(std::int64_t frame) override {
    const auto& keyframes = traverse_.keyframes;
    auto nearest = std::ranges::lower_bound(keyframes, frame, {}, &place::Keyframe::frame);
    if (nearest == keyframes.end() ||
        (nearest != keyframes.begin() && frame - (nearest - 1)->frame < nearest->frame - frame))
      --nearest;
    cv::Mat picture;
    if (!nearest->preview_jpeg.empty()) picture = cv::imdecode(nearest->preview_jpeg, cv::IMREAD_COLOR);
    if (picture.empty())
      throw vo::Error(fmt::format("traverse '{}'", traverse_.name),
                      fmt::format("has no preview of frame {}", nearest->frame),
                      "a route with previews, or --reference with the recording");
    return {picture, nearest->time_s};
  }

 private:
  const place::Traverse& traverse_;
};

}  // namespace

std::unique_ptr<WalkPictures> recorded_pictures(Recording recording, int width_px) {
  return std::make_unique<RecordedPictures>(std::move(recording), width_px);
}

std::unique_ptr<WalkPictures> preview_pictures(const place::Traverse& traverse) {
  const bool any = std::ranges::any_of(
      traverse.keyframes, [](const place::Keyframe& keyframe) { return !keyframe.preview_jpeg.empty(); });
  return any ? std::make_unique<PreviewPictures>(traverse) : nullptr;
}

}  // namespace retrace
