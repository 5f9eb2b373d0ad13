#include "io/video_decoder.hpp"

#include "vo/base/error.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/core.hpp>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

namespace vo {
namespace {

/// Calls one of FFmpeg's functions that free what a pointer points to and clear it.
template <auto free>
struct Free {
  template <typename T>
  void operator()(T* thing) const {
    free(&thing);
  }
};
using FormatContext = std::unique_ptr<AVFormatContext, Free<avformat_close_input>>;
using CodecContext = std::unique_ptr<AVCodecContext, Free<avcodec_free_context>>;
using Packet = std::unique_ptr<AVPacket, Free<av_packet_free>>;
using DecodedFrame = std::unique_ptr<AVFrame, Free<av_frame_free>>;

/// Whether luma goes from 0 to 255 rather than from 16 to 235 [ITU-R BT.601].
bool full_range(const AVFrame& frame) {
  switch (frame.format) {
    case AV_PIX_FMT_YUVJ420P:
    case AV_PIX_FMT_YUVJ422P:
    case AV_PIX_FMT_YUVJ444P:
    case AV_PIX_FMT_YUVJ440P:
    case AV_PIX_FMT_GRAY8:
      return true;
    default:
      return frame.color_range == AVCOL_RANGE_JPEG;
  }
}

/// Converts pictures of one size and format to another.
class Scaler {
 public:
  Scaler() = default;
  Scaler(const Scaler&) = delete;
  Scaler& operator=(const Scaler&) = delete;
  ~Scaler() { sws_freeContext(context_); }

  cv::Mat operator()(const AVFrame& frame, cv::Size size, AVPixelFormat format) {
    context_ = sws_getCachedContext(context_, frame.width, frame.height,
                                    static_cast<AVPixelFormat>(frame.format), size.width, size.height, format,
                                    SWS_AREA | SWS_ACCURATE_RND, nullptr, nullptr, nullptr);
    if (context_ == nullptr) return {};
    sws_setColorspaceDetails(context_, sws_getCoefficients(frame.colorspace), full_range(frame) ? 1 : 0,
                             sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, 1 << 16, 1 << 16);
    cv::Mat image(size, format == AV_PIX_FMT_GRAY8 ? CV_8UC1 : CV_8UC3);
    std::uint8_t* const planes[] = {image.data};
    const int strides[] = {static_cast<int>(image.step)};
    sws_scale(context_, frame.data, frame.linesize, 0, frame.height, planes, strides);
    return image;
  }

 private:
  SwsContext* context_ = nullptr;
};

/// The first plane, where it holds grey values of 8 bits; empty where it does not.
cv::Mat luma_plane(const AVFrame& frame) {
  const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  constexpr std::uint64_t kNoLuma = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BITSTREAM |
                                    AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_BAYER;
  if (format == nullptr || (format->flags & kNoLuma) != 0) return {};
  const AVComponentDescriptor& luma = format->comp[0];
  if (luma.plane != 0 || luma.depth != 8 || luma.step != 1 || luma.offset != 0 || luma.shift != 0) return {};
  return {frame.height, frame.width, CV_8UC1, frame.data[0], static_cast<std::size_t>(frame.linesize[0])};
}

/// Quarter turns clockwise that make the pictures of a stream upright.
int quarter_turns(const AVStream& stream) {
  const std::uint8_t* matrix = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
  if (matrix == nullptr) return 0;
  const double angle_deg = av_display_rotation_get(reinterpret_cast<const std::int32_t*>(matrix));
  if (!std::isfinite(angle_deg)) return 0;
  return static_cast<int>((std::lround(-angle_deg / 90) % 4 + 4) % 4);
}

cv::Mat upright(const cv::Mat& image, int quarter_turns) {
  if (quarter_turns == 0 || image.empty()) return image;
  constexpr cv::RotateFlags kTurns[] = {cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180,
                                        cv::ROTATE_90_COUNTERCLOCKWISE};
  cv::Mat turned;
  cv::rotate(image, turned, kTurns[quarter_turns - 1]);
  return turned;
}

cv::Size no_wider(const cv::Size& size, int width_px) {
  if (size.width <= width_px) return size;
  return {width_px, std::max(1, static_cast<int>(std::int64_t{size.height} * width_px / size.width))};
}

}  // namespace

struct VideoDecoder::State {
  std::string path;
  FormatContext format;
  const AVStream* stream = nullptr;
  CodecContext codec;
  Packet packet{av_packet_alloc()};
  DecodedFrame frame{av_frame_alloc()};
  Scaler to_grey, to_colour;
  int quarter_turns = 0;
  cv::Size size;         ///< of the pictures, as they are stored
  bool drained = false;  ///< there are no more packets

  /// Gives the decoder the next packet of the stream, or the news that there is none.
  void feed() {
    while (av_read_frame(format.get(), packet.get()) >= 0) {
      const bool ours = packet->stream_index == stream->index;
      if (ours) avcodec_send_packet(codec.get(), packet.get());
      av_packet_unref(packet.get());
      if (ours) return;
    }
    avcodec_send_packet(codec.get(), nullptr);
    drained = true;
  }

  cv::Mat grey() {
    const cv::Mat luma = luma_plane(*frame);
    if (luma.empty()) return to_grey(*frame, size, AV_PIX_FMT_GRAY8);
    cv::Mat image;
    if (full_range(*frame)) {
      luma.copyTo(image);
    } else {
      luma.convertTo(image, CV_8U, 255.0 / 219, -16 * 255.0 / 219);
    }
    return image;
  }
};

VideoDecoder::VideoDecoder(const std::string& path) : state_(std::make_unique<State>()) {
  av_log_set_level(AV_LOG_QUIET);  // libraries do not print; what matters is thrown, or counted in frames
  State& s = *state_;
  s.path = path;
  const auto require = [&](bool fine) {
    if (!fine) {
      throw Error(path, "is no video that FFmpeg can read", "a video file, a folder of images, or camera:N");
    }
  };
  AVFormatContext* opened = nullptr;
  require(avformat_open_input(&opened, ("file:" + path).c_str(), nullptr, nullptr) == 0);
  s.format.reset(opened);
  require(avformat_find_stream_info(opened, nullptr) >= 0);
  const AVCodec* codec = nullptr;
  const int index = av_find_best_stream(opened, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
  require(index >= 0 && codec != nullptr);
  for (unsigned i = 0; i < opened->nb_streams; ++i) {
    if (static_cast<int>(i) != index) opened->streams[i]->discard = AVDISCARD_ALL;
  }
  s.stream = opened->streams[index];
  s.quarter_turns = quarter_turns(*s.stream);
  s.codec.reset(avcodec_alloc_context3(codec));
  require(avcodec_parameters_to_context(s.codec.get(), s.stream->codecpar) >= 0);
  s.codec->thread_count = 0;  // as many as there are cores
  require(avcodec_open2(s.codec.get(), codec, nullptr) == 0);
}

VideoDecoder::~VideoDecoder() = default;

std::optional<VideoDecoder::Picture> VideoDecoder::next(int colour_width_px) {
  State& s = *state_;
  for (int result = -1; result != 0;) {
    result = avcodec_receive_frame(s.codec.get(), s.frame.get());
    if (result == AVERROR_EOF || (result == AVERROR(EAGAIN) && s.drained)) return std::nullopt;
    if (result == AVERROR(EAGAIN)) s.feed();
  }
  const AVFrame& frame = *s.frame;
  const cv::Size size(frame.width, frame.height);
  if (s.size.empty()) s.size = size;
  if (size != s.size) {
    throw Error(s.path, fmt::format("goes on with {}x{} pixels", size.width, size.height),
                fmt::format("{}x{} as at its start", s.size.width, s.size.height));
  }
  Picture picture{.grey = upright(s.grey(), s.quarter_turns)};
  if (picture.grey.empty()) throw Error(s.path, "has pixels of a format that FFmpeg cannot convert");
  if (colour_width_px > 0) {
    const bool on_its_side = s.quarter_turns % 2 == 1;
    const cv::Size wanted = no_wider(picture.grey.size(), colour_width_px);
    const cv::Size stored = on_its_side ? cv::Size(wanted.height, wanted.width) : wanted;
    picture.colour = upright(s.to_colour(frame, stored, AV_PIX_FMT_BGR24), s.quarter_turns);
  }
  if (frame.best_effort_timestamp != AV_NOPTS_VALUE) {
    picture.time_s = static_cast<double>(frame.best_effort_timestamp) * av_q2d(s.stream->time_base);
  }
  return picture;
}

std::optional<double> VideoDecoder::rate_hz() const {
  const State& s = *state_;
  const double rate = av_q2d(av_guess_frame_rate(s.format.get(), const_cast<AVStream*>(s.stream), nullptr));
  return std::isfinite(rate) && rate > 0 ? std::optional(rate) : std::nullopt;
}

std::optional<std::int64_t> VideoDecoder::expected_frames() const {
  const State& s = *state_;
  if (s.stream->nb_frames > 0) return s.stream->nb_frames;
  if (s.format->duration <= 0 || !rate_hz()) return std::nullopt;
  return std::llround(static_cast<double>(s.format->duration) / AV_TIME_BASE * *rate_hz());
}

}  // namespace vo
