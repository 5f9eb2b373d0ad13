#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include <vo/base/rng.hpp>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace test_support {

/// How a `VideoWriter` writes.
struct VideoOptions {
  const char* codec = "mpeg4";  ///< mpeg4 for .mp4 and .mov, ffv1 for .mkv, which loses nothing
  int quantiser = 2;            ///< mpeg4's, 2 to 31
  int key_frame_every = 12;
  AVRational pixel_aspect{1, 1};
  std::optional<std::array<std::int32_t, 9>> display_matrix;  ///< 16.16 fixed point, the last column 2.30
  std::map<std::string, std::string> tags;                    ///< of the container
  double rate_hz = 25;                                        ///< that it says
  double sound_s = 0;                                         ///< length of a silent sound track; .mov only
  std::vector<std::string> telemetry;  ///< pieces of a track of a second each that is called gpmd; .mp4, .mov
};

/// Writes videos for tests, frame by frame at any time, with FFmpeg's own encoders.
class VideoWriter {
 public:
  VideoWriter(const std::filesystem::path& path, cv::Size size, VideoOptions options = {})
      : options_(std::move(options)) {
    need(avformat_alloc_output_context2(&format_, nullptr, nullptr, path.c_str()) >= 0);
    const AVCodec* encoder = avcodec_find_encoder_by_name(options_.codec);
    need(encoder != nullptr);
    codec_ = avcodec_alloc_context3(encoder);
    codec_->width = size.width;
    codec_->height = size.height;
    codec_->time_base = {1, 1000};
    codec_->framerate = av_d2q(options_.rate_hz, 1000);
    codec_->sample_aspect_ratio = options_.pixel_aspect;
    codec_->gop_size = options_.key_frame_every;
    codec_->flags |= AV_CODEC_FLAG_QSCALE;
    codec_->global_quality = options_.quantiser * FF_QP2LAMBDA;
    if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    stream_ = avformat_new_stream(format_, nullptr);
    for (const auto& [name, value] : options_.tags)
      av_dict_set(&format_->metadata, name.c_str(), value.c_str(), 0);
    path_ = path.string();
  }
  ~VideoWriter() {
    if (begun_) {
      encode(nullptr);
      write_sound();
      write_telemetry();
      av_write_trailer(format_);
      avio_closep(&format_->pb);
    }
    av_frame_free(&frame_);
    avcodec_free_context(&codec_);
    avformat_free_context(format_);
  }
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// A grey picture of 8 bits, or of 16 for ffv1, at a time.
  void write(const cv::Mat& grey, double time_s) {
    if (!begun_) begin(grey.depth() == CV_16U ? AV_PIX_FMT_GRAY16LE : AV_PIX_FMT_YUV420P);
    need(av_frame_make_writable(frame_) == 0);
    for (int row = 0; row < grey.rows; ++row) {
      std::uint8_t* line = frame_->data[0] + static_cast<std::ptrdiff_t>(row) * frame_->linesize[0];
      if (grey.depth() == CV_16U) {
        std::memcpy(line, grey.ptr(row), 2 * static_cast<std::size_t>(grey.cols));
      } else {  // video levels: 16 to 235
        for (int x = 0; x < grey.cols; ++x)
          line[x] = static_cast<std::uint8_t>(16 + (grey.at<std::uint8_t>(row, x) * 219 + 127) / 255);
      }
    }
    frame_->pts = std::llround(1000 * time_s);
    encode(frame_);
  }

 private:
  static void need(bool fine) {
    if (!fine) throw std::runtime_error("VideoWriter: FFmpeg refuses");
  }

  void begin(AVPixelFormat pixels) {
    codec_->pix_fmt = pixels;
    need(avcodec_open2(codec_, codec_->codec, nullptr) == 0);
    need(avcodec_parameters_from_context(stream_->codecpar, codec_) >= 0);
    stream_->time_base = codec_->time_base;
    stream_->avg_frame_rate = codec_->framerate;
    stream_->sample_aspect_ratio = options_.pixel_aspect;
    if (options_.display_matrix) {
      std::uint8_t* data =
          av_stream_new_side_data(stream_, AV_PKT_DATA_DISPLAYMATRIX, sizeof(*options_.display_matrix));
      std::memcpy(data, options_.display_matrix->data(), sizeof(*options_.display_matrix));
    }
    if (options_.sound_s > 0) {
      sound_ = avformat_new_stream(format_, nullptr);
      sound_->codecpar->codec_type = AVMEDIA_TYPE_AUDIO;
      sound_->codecpar->codec_id = AV_CODEC_ID_PCM_S16LE;
      sound_->codecpar->sample_rate = kSampleRate;
      sound_->codecpar->format = AV_SAMPLE_FMT_S16;
      sound_->codecpar->bits_per_coded_sample = 16;
      sound_->codecpar->block_align = 2;
      sound_->codecpar->ch_layout = AV_CHANNEL_LAYOUT_MONO;
      sound_->time_base = {1, kSampleRate};
    }
    if (!options_.telemetry.empty()) {
      telemetry_ = avformat_new_stream(format_, nullptr);
      telemetry_->codecpar->codec_type = AVMEDIA_TYPE_DATA;
      telemetry_->codecpar->codec_id = AV_CODEC_ID_BIN_DATA;
      telemetry_->codecpar->codec_tag = MKTAG('g', 'p', 'm', 'd');
      telemetry_->time_base = {1, 1000};
    }
    frame_ = av_frame_alloc();
    frame_->format = pixels;
    frame_->width = codec_->width;
    frame_->height = codec_->height;
    need(av_frame_get_buffer(frame_, 0) == 0);
    for (int plane = 1; plane < 3 && frame_->data[plane] != nullptr; ++plane)
      std::memset(frame_->data[plane], 128,
                  static_cast<std::size_t>(frame_->linesize[plane]) * frame_->height / 2);
    need(avio_open(&format_->pb, path_.c_str(), AVIO_FLAG_WRITE) >= 0);
    AVDictionary* muxer = nullptr;
    if (!options_.tags.empty() && std::string(format_->oformat->name) != "matroska")
      av_dict_set(&muxer, "movflags", "use_metadata_tags", 0);
    need(avformat_write_header(format_, &muxer) >= 0);
    av_dict_free(&muxer);
    begun_ = true;
  }

  void encode(const AVFrame* frame) {
    need(avcodec_send_frame(codec_, frame) == 0);
    AVPacket* packet = av_packet_alloc();
    while (avcodec_receive_packet(codec_, packet) == 0) {
      av_packet_rescale_ts(packet, codec_->time_base, stream_->time_base);
      if (packet->duration == 0)
        packet->duration = av_rescale_q(std::llround(1000 / options_.rate_hz), {1, 1000}, stream_->time_base);
      packet->stream_index = stream_->index;
      need(av_interleaved_write_frame(format_, packet) >= 0);
    }
    av_packet_free(&packet);
  }

  void write_sound() {
    if (sound_ == nullptr) return;
    AVPacket* packet = av_packet_alloc();
    for (std::int64_t at = 0; at < static_cast<std::int64_t>(options_.sound_s * kSampleRate);
         at += kSampleRate) {
      av_new_packet(packet, 2 * kSampleRate);
      std::memset(packet->data, 0, static_cast<std::size_t>(packet->size));
      packet->pts = packet->dts = av_rescale_q(at, {1, kSampleRate}, sound_->time_base);
      packet->duration = av_rescale_q(kSampleRate, {1, kSampleRate}, sound_->time_base);
      packet->stream_index = sound_->index;
      av_interleaved_write_frame(format_, packet);
    }
    av_packet_free(&packet);
  }

  void write_telemetry() {
    if (telemetry_ == nullptr) return;
    AVPacket* packet = av_packet_alloc();
    for (std::size_t i = 0; i < options_.telemetry.size(); ++i) {
      const std::string& piece = options_.telemetry[i];
      av_new_packet(packet, static_cast<int>(piece.size()));
      std::memcpy(packet->data, piece.data(), piece.size());
      packet->pts = packet->dts = av_rescale_q(static_cast<std::int64_t>(i), {1, 1}, telemetry_->time_base);
      packet->duration = av_rescale_q(1, {1, 1}, telemetry_->time_base);
      packet->stream_index = telemetry_->index;
      need(av_interleaved_write_frame(format_, packet) >= 0);
    }
    av_packet_free(&packet);
  }

  static constexpr int kSampleRate = 8000;
  VideoOptions options_;
  std::string path_;
  AVFormatContext* format_ = nullptr;
  AVCodecContext* codec_ = nullptr;
  AVStream* stream_ = nullptr;
  AVStream* sound_ = nullptr;
  AVStream* telemetry_ = nullptr;
  AVFrame* frame_ = nullptr;
  bool begun_ = false;
};

/// A picture with something to see in it: bright on the left, dark on the right, a white square above on the
/// left.
inline cv::Mat corner_picture(cv::Size size = {64, 48}) {
  cv::Mat picture(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x)
      picture.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(160 - 100 * x / size.width);
  }
  picture(cv::Rect(0, 0, size.width / 4, size.height / 4)).setTo(250);
  return picture;
}

/// A video of so many frames at an even rate; every frame is `picture` with a grey level of its own below on
/// the right.
inline void write_video(const std::filesystem::path& path, int frames, const VideoOptions& options = {},
                        const cv::Mat& picture = corner_picture()) {
  VideoWriter writer(path, picture.size(), options);
  for (int i = 0; i < frames; ++i) {
    cv::Mat frame = picture.clone();
    const int w = frame.cols / 4, h = frame.rows / 4;
    frame(cv::Rect(frame.cols - w, frame.rows - h, w, h)).setTo(cv::Scalar(20 + 7 * (i % 30)));
    writer.write(frame, i / options.rate_hz);
  }
}

/// A scene of 2.8 s that moves enough that every packet has something to break.
inline void write_moving_noise(const std::filesystem::path& path) {
  VideoWriter writer(path, {160, 128}, {.quantiser = 3, .key_frame_every = 20});
  vo::Rng rng(5);
  cv::Mat noise(128, 240, CV_8UC1);
  for (auto value = noise.begin<std::uint8_t>(); value != noise.end<std::uint8_t>(); ++value)
    *value = static_cast<std::uint8_t>(rng.index(256));
  for (int i = 0; i < 70; ++i) writer.write(noise.colRange(i, i + 160), i / 25.0);
}

/// The bytes of an .mp4 with ten holes shot into the middle of what is coded, so that neither the first
/// picture nor the index at the end is hit.
inline std::string damaged(std::string bytes, std::uint64_t seed) {
  vo::Rng rng(seed);
  const std::size_t data = bytes.find("mdat");
  if (data == std::string::npos) throw std::runtime_error("damaged: an .mp4 expected");
  for (int i = 0; i < 10; ++i) {
    const std::size_t at = data + bytes.size() / 4 + rng.index(bytes.size() / 2);
    for (std::size_t k = 0; k < 16; ++k) bytes[at + k] = static_cast<char>(rng.index(256));
  }
  return bytes;
}

}  // namespace test_support
