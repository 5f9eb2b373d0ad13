#include "io/frame_sources.hpp"
#include "vo/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace vo {
namespace {

class ChainedSource final : public FrameSource {
 public:
  ChainedSource(std::span<const std::string> walks, const FrameSourceOptions& options)
      : walks_(walks.begin(), walks.end()), options_(options) {
    std::int64_t frames = 0;
    bool all_said = true;
    for (const std::string& walk : walks_) {  // all are there before the first is read
      const auto source = open_frame_source(walk, options);
      const auto expected = source->expected_frames();
      all_said = all_said && expected;
      frames += expected.value_or(0);
    }
    if (all_said) expected_ = frames;
    current_ = open_frame_source(walks_[0], options_);
    start_utc_s_ = current_->start_utc_s();
  }

  std::optional<Frame> next() override {
    for (;;) {
      std::optional<Frame> frame = current_->next();
      if (frame) {
        if (size_.empty()) size_ = frame->image.size();
        if (frame->image.size() != size_) {
          throw Error(walks_[number_],
                      fmt::format("has pictures of {}x{} pixels", frame->image.cols, frame->image.rows),
                      fmt::format("{}x{} as {}", size_.width, size_.height, walks_[0]));
        }
        step_s_ = frame->time_s > file_time_s_ ? frame->time_s - file_time_s_ : step_s_;
        file_time_s_ = frame->time_s;
        frame->time_s += begin_s_;
        frame->index = count_++;
        return frame;
      }
      std::ranges::move(current_->warnings(), std::back_inserter(past_warnings_));
      if (number_ + 1 == walks_.size()) {
        finished_ = true;
        return std::nullopt;
      }
      go_on();
    }
  }

  [[nodiscard]] std::optional<std::int64_t> expected_frames() const override { return expected_; }
  [[nodiscard]] std::optional<double> start_utc_s() const override { return start_utc_s_; }

  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = past_warnings_;
    if (!finished_) std::ranges::move(current_->warnings(), std::back_inserter(all));
    return all;
  }

 private:
  /// Opens the next file; its times begin after those of the one before, and what lies between.
  void go_on() {
    const std::optional<double> before_utc_s = current_->start_utc_s();
    ++number_;
    current_ = open_frame_source(walks_[number_], options_);
    // A file of one frame does not say how long that is shown.
    const double step_s = step_s_ > 0 ? step_s_ : 1 / options_.frame_rate_hz.value_or(kImageRate_hz);
    const double length_s = file_time_s_ + step_s;
    begin_s_ += length_s + pause_s(before_utc_s, length_s);
    file_time_s_ = 0;
  }

  double pause_s(const std::optional<double>& before_utc_s, double length_s) {
    constexpr double kSame_s = 1.5;           // creation times are whole seconds
    constexpr double kLongest_s = 12 * 3600;  // a longer pause ends a walk
    const std::optional<double> utc_s = current_->start_utc_s();
    if (before_utc_s && utc_s) {
      const double between_s = *utc_s - *before_utc_s - length_s;
      const bool one_recording =
          std::abs(*utc_s - *before_utc_s) <= kSame_s;  // all chapters have its beginning
      if (one_recording || std::abs(between_s) <= kSame_s) return 0;
      if (between_s > 0 && between_s <= kLongest_s) {
        past_warnings_.push_back(fmt::format("{}: begins {:.0f} s after {} ends, as their creation times say",
                                             walks_[number_], between_s, walks_[number_ - 1]));
        return between_s;
      }
      if (between_s < 0) {
        past_warnings_.push_back(fmt::format(
            "{}: was recorded before {} ended, as their creation times say; are they in order? {} s "
            "between them is taken",
            walks_[number_], walks_[number_ - 1], kUnknownPause_s));
        return kUnknownPause_s;
      }
    }
    past_warnings_.push_back(fmt::format("{}: does not say how long after {} it begins; {} s is taken",
                                         walks_[number_], walks_[number_ - 1], kUnknownPause_s));
    return kUnknownPause_s;
  }

  std::vector<std::string> walks_;
  FrameSourceOptions options_;
  std::unique_ptr<FrameSource> current_;
  std::size_t number_ = 0;  ///< of the file that is read
  std::optional<std::int64_t> expected_;
  std::optional<double> start_utc_s_;
  std::vector<std::string> past_warnings_;  ///< of the files before
  bool finished_ = false;
  cv::Size size_;
  std::int64_t count_ = 0;
  double begin_s_ = 0;      ///< time of the file's first frame
  double file_time_s_ = 0;  ///< of the last frame, since the file's first
  double step_s_ = 0;       ///< between the last two frames of a file
};

}  // namespace

std::unique_ptr<FrameSource> chained(std::span<const std::string> walks, const FrameSourceOptions& options) {
  return std::make_unique<ChainedSource>(walks, options);
}

}  // namespace vo
