#include "vo/io/video_writer.hpp"

#include "io/ffmpeg.hpp"
#include "vo/base/error.hpp"
#include "vo/io/atomic_file.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

extern "C" {
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace vo {
namespace {

constexpr int kThreads = 4;  // of the encoder; its bytes depend on their number

}  // namespace

struct VideoWriter::State {
  State(const std::filesystem::path& to, cv::Size of, double rate_hz)
      : path(to.string()), size(of), file(to), packet(av_packet_alloc()), frame(av_frame_alloc()) {
    AVFormatContext* output = nullptr;
    require(avformat_alloc_output_context2(&output, nullptr, "mp4", file.temporary().c_str()));
    format.reset(output);
    open_codec(rate_hz);
    stream = avformat_new_stream(output, nullptr);
    require(stream == nullptr ? AVERROR(ENOMEM)
                              : avcodec_parameters_from_context(stream->codecpar, codec.get()));
    stream->time_base = codec->time_base;
    stream->avg_frame_rate = codec->framerate;
    frame->format = codec->pix_fmt;
    frame->width = size.width;
    frame->height = size.height;
    require(av_frame_get_buffer(frame.get(), 0));
    scaler.reset(sws_getContext(size.width, size.height, AV_PIX_FMT_BGR24, size.width, size.height,
                                codec->pix_fmt, SWS_BILINEAR, nullptr, nullptr, nullptr));
    if (!scaler) require(AVERROR(ENOMEM));
    require(avio_open(&output->pb, ("file:" + file.temporary().string()).c_str(), AVIO_FLAG_WRITE));
    require(avformat_write_header(output, nullptr));
  }

  void require(int code) const {
    if (code < 0)
      throw Error(path, fmt::format("cannot be written: {}", ffmpeg::reason(code)),
                  "a folder that exists, is writable and has room");
  }

  void open_codec(double rate_hz) {
    const AVCodec* encoder = avcodec_find_encoder_by_name("libx264");
    const bool h264 = encoder != nullptr;
    if (!h264) encoder = avcodec_find_encoder(AV_CODEC_ID_MPEG4);
    if (encoder == nullptr) require(AVERROR_ENCODER_NOT_FOUND);
    codec.reset(avcodec_alloc_context3(encoder));
    codec->width = size.width;
    codec->height = size.height;
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    codec->color_range = AVCOL_RANGE_MPEG;
    codec->colorspace = AVCOL_SPC_SMPTE170M;  // what swscale makes of BGR
    codec->framerate = av_d2q(rate_hz, 1001000);
    codec->time_base = av_inv_q(codec->framerate);
    codec->gop_size = std::max(1, static_cast<int>(std::lround(rate_hz)));  // a second, to jump about in it
    codec->thread_count = kThreads;
    codec->log_level_offset = AV_LOG_TRACE;  // x264 tells all about itself otherwise
    if ((format->oformat->flags & AVFMT_GLOBALHEADER) != 0) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    if (h264) {
      av_opt_set(codec->priv_data, "preset", "superfast", 0);
      av_opt_set(codec->priv_data, "crf", "21", 0);  // losses hardly seen
    } else {
      constexpr int kQuantiser = 4;
      codec->flags |= AV_CODEC_FLAG_QSCALE;
      codec->global_quality = kQuantiser * FF_QP2LAMBDA;
    }
    require(avcodec_open2(codec.get(), encoder, nullptr));
  }

  /// Null: the last pictures.
  void encode(const AVFrame* picture) {
    require(avcodec_send_frame(codec.get(), picture));
    for (;;) {
      const int code = avcodec_receive_packet(codec.get(), packet.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      require(code);
      if (packet->duration == 0) packet->duration = 1;
      av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
      packet->stream_index = stream->index;
      require(av_interleaved_write_frame(format.get(), packet.get()));
    }
  }

  std::string path;
  cv::Size size;
  AtomicFile file;  ///< outlives what writes to it
  ffmpeg::OutputContext format;
  ffmpeg::CodecContext codec;
  AVStream* stream = nullptr;
  ffmpeg::Packet packet;
  ffmpeg::DecodedFrame frame;
  struct FreeScaler {
    void operator()(SwsContext* context) const { sws_freeContext(context); }
  };
  std::unique_ptr<SwsContext, FreeScaler> scaler;
  std::int64_t written = 0;
};

VideoWriter::VideoWriter(const std::filesystem::path& path, cv::Size size, double rate_hz) {
  if (size.width < 2 || size.height < 2 || size.width % 2 != 0 || size.height % 2 != 0)
    throw std::invalid_argument("VideoWriter: even numbers of pixels expected");
  if (!(rate_hz > 0 && rate_hz <= 1000))
    throw std::invalid_argument("VideoWriter: a rate up to 1000 expected");
  state_ = std::make_unique<State>(path, size, rate_hz);
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::write(const cv::Mat& bgr) {
  State& s = *state_;
  if (bgr.type() != CV_8UC3 || bgr.size() != s.size)
    throw std::invalid_argument("VideoWriter: BGR pictures of one size expected");
  s.require(av_frame_make_writable(s.frame.get()));
  const std::uint8_t* const planes[] = {bgr.data};
  const int strides[] = {static_cast<int>(bgr.step)};
  sws_scale(s.scaler.get(), planes, strides, 0, bgr.rows, s.frame->data, s.frame->linesize);
  s.frame->pts = s.written++;
  s.encode(s.frame.get());
}

void VideoWriter::finish() {
  State& s = *state_;
  if (s.written == 0) throw std::invalid_argument("VideoWriter: no picture was written");
  s.encode(nullptr);
  s.require(av_write_trailer(s.format.get()));
  s.require(avio_closep(&s.format->pb));
  s.file.commit();
}

}  // namespace vo
