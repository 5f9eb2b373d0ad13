#include "io/frame_picture.hpp"
#include "io/frame_sources.hpp"
#include "io/packet_decoder.hpp"
#include "io/recording_tags.hpp"
#include "vo/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

namespace vo {
namespace {

cv::Size no_wider(const cv::Size& size, int width_px) {
  if (size.width <= width_px) return size;
  return {width_px, std::max(1, static_cast<int>(std::int64_t{size.height} * width_px / size.width))};
}

std::optional<double> nominal_rate_hz(const PacketDecoder& decoder) {
  const double rate = av_q2d(av_guess_frame_rate(const_cast<AVFormatContext*>(&decoder.format()),
                                                 const_cast<AVStream*>(&decoder.stream()), nullptr));
  return std::isfinite(rate) && rate > 0 ? std::optional(rate) : std::nullopt;
}

/// When the stream's pictures should end, in its own time, as far as the container says it: sound may be
/// longer, and an edit list may leave pictures out, so that neither the file's duration nor its count of
/// frames says it.
std::optional<double> expected_end_s(const PacketDecoder& decoder) {
  const AVFormatContext& format = decoder.format();
  const AVStream& stream = decoder.stream();
  const double start_s = stream.start_time != AV_NOPTS_VALUE ? decoder.seconds(stream.start_time) : 0;
  if (format.duration_estimation_method == AVFMT_DURATION_FROM_BITRATE) return std::nullopt;
  if (stream.duration > 0) return start_s + decoder.seconds(stream.duration);
  if (const AVDictionaryEntry* entry = av_dict_get(stream.metadata, "DURATION", nullptr, 0)) {  // Matroska's
    int hours = 0, minutes = 0;
    double seconds = 0;
    if (std::sscanf(entry->value, "%d:%d:%lf", &hours, &minutes, &seconds) == 3)
      return 3600 * hours + 60 * minutes + seconds;
  }
  if (format.nb_streams == 1 && format.duration > 0)
    return start_s + static_cast<double>(format.duration) / AV_TIME_BASE;
  return std::nullopt;
}

/// Pictures from all over a file, each converted by `convert`; none of what cannot be searched.
template <typename Convert>
std::vector<cv::Mat> look_ahead(const std::string& source, std::size_t count, const Convert& convert) {
  std::vector<cv::Mat> pictures;
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(source, unknown)) return pictures;  // a pipe gives its bytes once
  PacketDecoder decoder(source, 1);
  const double begin_s =
      decoder.stream().start_time != AV_NOPTS_VALUE ? decoder.seconds(decoder.stream().start_time) : 0;
  const double end_s = expected_end_s(decoder).value_or(begin_s);
  for (std::size_t i = 0; i < count; ++i) {
    const double at_s = begin_s + (end_s - begin_s) * static_cast<double>(i) / static_cast<double>(count);
    if (i > 0 && (!(end_s > begin_s) || !decoder.seek(at_s))) break;
    const AVFrame* frame = decoder.next();
    if (frame == nullptr) break;
    cv::Mat picture = convert(*frame);
    if (!picture.empty()) pictures.push_back(std::move(picture));
  }
  return pictures;
}

class VideoSource final : public SampledSource {
 public:
  VideoSource(const std::string& source, const FrameSourceOptions& options)
      : source_(source),
        name_(source == "-" ? "standard input" : source),
        options_(options),
        decoder_(source),
        upright_(upright_of(decoder_.format(), decoder_.stream())),
        rate_hz_(nominal_rate_hz(decoder_)),
        tags_(recording_tags(decoder_.format(), decoder_.stream(), rate_hz_)) {
    if (options_.frame_rate_hz && rate_hz_)
      time_scale_ = *rate_hz_ / *options_.frame_rate_hz;
    else if (tags_.capture_rate_hz)
      time_scale_ = time_scale(*rate_hz_, *tags_.capture_rate_hz);
    const AVFrame* first = decoder_.next();
    if (first == nullptr) throw Error(name_, "holds no frame that can be decoded", "a video");
    find_range(*first);
    lookahead_ = made(*first);
  }

  std::optional<Frame> next() override {
    std::optional<Frame> frame = std::move(lookahead_);
    lookahead_.reset();
    if (frame) return frame;
    const AVFrame* decoded = decoder_.next();
    if (decoded == nullptr) return std::nullopt;
    return made(*decoded);
  }

  [[nodiscard]] std::vector<cv::Mat> sample(std::size_t count) const override {
    if (!options_.look_ahead) return {};
    FramePictures pictures;
    return look_ahead(source_, count, [&](const AVFrame& frame) {
      return made_upright(pictures.grey(frame, range_.value_or(GreyRange())), upright_);
    });
  }

  [[nodiscard]] std::optional<std::int64_t> expected_frames() const override {
    if (decoder_.stream().nb_frames > 0) return decoder_.stream().nb_frames;
    if (decoder_.format().duration <= 0 || !rate_hz_) return std::nullopt;
    return std::llround(static_cast<double>(decoder_.format().duration) / AV_TIME_BASE * *rate_hz_);
  }

  [[nodiscard]] std::optional<double> start_utc_s() const override {
    if (!tags_.created_utc_s || !tags_.created_at_end) return tags_.created_utc_s;
    const auto playing_s =
        static_cast<double>(std::max<std::int64_t>(decoder_.format().duration, 0)) / AV_TIME_BASE;
    return *tags_.created_utc_s - time_scale_ * playing_s;
  }

  [[nodiscard]] std::vector<std::string> warnings() const override;

 private:
  void find_range(const AVFrame& first) {
    const cv::Mat deep = FramePictures::deep_grey(first);
    if (deep.empty()) return;
    std::vector<cv::Mat> pictures{thinned(deep)};
    if (options_.look_ahead) {
      std::ranges::move(
          look_ahead(source_, kSamples,
                     [](const AVFrame& frame) { return thinned(FramePictures::deep_grey(frame)); }),
          std::back_inserter(pictures));
    }
    range_ = range_of(pictures).value_or(GreyRange());
  }

  Frame made(const AVFrame& frame) {
    const cv::Size size(frame.width, frame.height);
    if (size_.empty()) size_ = size;
    if (size != size_) {
      throw Error(name_, fmt::format("goes on with {}x{} pixels", size.width, size.height),
                  fmt::format("{}x{} as at its start", size_.width, size_.height));
    }
    Frame result{.image = made_upright(pictures_.grey(frame, range_.value_or(GreyRange())), upright_)};
    if (result.image.empty()) throw Error(name_, "has pixels of a format that FFmpeg cannot convert");
    if (options_.colour_width_px > 0 && !range_) {
      const bool on_its_side = upright_.quarter_turns % 2 == 1;
      const cv::Size wanted = no_wider(result.image.size(), options_.colour_width_px);
      const cv::Size stored = on_its_side ? cv::Size(wanted.height, wanted.width) : wanted;
      Upright turn = upright_;
      turn.pixel_aspect = 1;  // the size asked for has it already
      result.colour = made_upright(pictures_.colour(frame, stored), turn);
    }
    result.time_s = time_of(frame);
    result.index = count_++;
    return result;
  }

  double time_of(const AVFrame& frame) {
    if (options_.frame_rate_hz) return static_cast<double>(count_) / *options_.frame_rate_hz;
    std::optional<double> stamp_s;
    if (frame.best_effort_timestamp != AV_NOPTS_VALUE)
      stamp_s = time_scale_ * decoder_.seconds(frame.best_effort_timestamp);
    constexpr double kUsualRate_hz = 30;
    const double next_s = count_ == 0 ? 0 : last_time_s_ + time_scale_ / rate_hz_.value_or(kUsualRate_hz);
    if (stamp_s && !origin_s_) origin_s_ = *stamp_s - next_s;  // streams may begin with frames of no time
    if (stamp_s && (count_ == 0 || *stamp_s - *origin_s_ > last_time_s_)) {
      last_time_s_ = *stamp_s - *origin_s_;
    } else {
      last_time_s_ = next_s;
      ++untimed_;
    }
    return last_time_s_;
  }

  std::string source_;
  std::string name_;
  FrameSourceOptions options_;
  PacketDecoder decoder_;
  FramePictures pictures_;
  Upright upright_;
  std::optional<double> rate_hz_;
  RecordingTags tags_;
  double time_scale_ = 1;           ///< true time by the file's
  std::optional<GreyRange> range_;  ///< of a walk of deep pictures
  std::optional<Frame> lookahead_;
  cv::Size size_;  ///< of the pictures, as they are stored
  std::int64_t count_ = 0;
  std::int64_t untimed_ = 0;
  std::optional<double> origin_s_;  ///< the stream's time of the first frame
  double last_time_s_ = 0;
};

std::vector<std::string> VideoSource::warnings() const {
  std::vector<std::string> all;
  const DecodingReport& report = decoder_.report();
  const std::int64_t frames = decoder_.stream().nb_frames;
  const double step_s = 1 / rate_hz_.value_or(10);
  const std::optional<double> end_s = expected_end_s(decoder_);
  constexpr double kRounded_s = 0.1;  // containers round durations, some to a few frames
  // A file that was cut short may state the duration of what is left, and still the number of frames that
  // there were. Where there are edit lists that number says nothing: they leave frames out on purpose.
  const std::string_view container = decoder_.format().iformat->name;
  const bool edited = container.find("mov") != std::string_view::npos;
  const bool fewer = !edited && frames > count_ + report.damaged + 1;
  if (report.ended && (fewer || (end_s && report.end_s + 2 * step_s + kRounded_s < *end_s))) {
    all.push_back(
        frames > count_
            ? fmt::format("{}: breaks off: {} of {} frames could be read", name_, count_, frames)
            : fmt::format("{}: breaks off: {:.1f} of {:.1f} s could be read", name_, report.end_s, *end_s));
  }
  if (report.damaged > 0) {
    all.push_back(fmt::format("{}: {} damaged {}{}; what is shown there may be wrong", name_, report.damaged,
                              report.damaged == 1 ? "frame" : "frames",
                              report.first_damaged_s
                                  ? fmt::format(", the first at {:.1f} s", *report.first_damaged_s)
                                  : std::string()));
  }
  if (untimed_ > 0) {
    all.push_back(
        fmt::format("{}: {} frames have no usable time; the nominal rate is used for them", name_, untimed_));
  }
  if (tags_.capture_rate_hz && !options_.frame_rate_hz) {
    all.push_back(
        fmt::format("{}: recorded at {:.4g} frames/s, as its tag says, and played at {:.4g}; times are those "
                    "of the recording "
                    "(--frame-rate-hz says otherwise)",
                    name_, *tags_.capture_rate_hz, *rate_hz_));
  }
  if (range_) {
    all.push_back(
        fmt::format("{}: pictures of more than 8 bits: {:.6g} is taken for black and {:.6g} for white", name_,
                    range_->black, range_->white));
  }
  return all;
}

}  // namespace

std::unique_ptr<SampledSource> open_video(const std::string& source, const FrameSourceOptions& options) {
  return std::make_unique<VideoSource>(source, options);
}

}  // namespace vo
