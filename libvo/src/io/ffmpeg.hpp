#pragma once

#include <array>
#include <memory>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

/// FFmpeg's objects, freed when they are done with, and its errors in words.
namespace vo::ffmpeg {

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
/// A file being written.
struct FreeOutput {
  void operator()(AVFormatContext* format) const {
    avio_closep(&format->pb);
    avformat_free_context(format);
  }
};
using OutputContext = std::unique_ptr<AVFormatContext, FreeOutput>;
using DecodedFrame = std::unique_ptr<AVFrame, Free<av_frame_free>>;

/// What an error code means.
inline std::string reason(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  return av_strerror(code, text.data(), text.size()) == 0 ? text.data() : std::string("unknown");
}

}  // namespace vo::ffmpeg
