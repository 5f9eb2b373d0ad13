#pragma once

#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

/// FFmpeg's objects, freed when they are done with.
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
using DecodedFrame = std::unique_ptr<AVFrame, Free<av_frame_free>>;

}  // namespace vo::ffmpeg
