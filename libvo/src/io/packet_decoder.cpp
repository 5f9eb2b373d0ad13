#include "io/packet_decoder.hpp"

#include "vo/base/error.hpp"
#include "vo/base/parallel.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

namespace vo {
namespace {

constexpr std::string_view kRecordingForms =
    "a video file, a folder of images, camera:N, rtsp://..., or - (Y4M)";

bool is_address(const std::string& source) {
  return source.starts_with("rtsp://") || source.starts_with("rtsps://");
}

/// Opens the source's container. Throws `Error` saying what it should have been.
AVFormatContext* opened(const std::string& source) {
  AVFormatContext* format = nullptr;
  AVDictionary* options = nullptr;
  const AVInputFormat* form = nullptr;
  std::string url = "file:" + source;
  std::string expected(kRecordingForms), problem = "is no video that FFmpeg can read";
  if (source == "-") {
    url = "pipe:0";
    form = av_find_input_format("yuv4mpegpipe");
    problem = "holds no Y4M";
    expected = "for example: ffmpeg -i walk.mp4 -f yuv4mpegpipe - | retrace ... -";
  } else if (is_address(source)) {
    url = source;
    av_dict_set(&options, "rtsp_transport", "tcp", 0);  // lost packets would be damaged pictures
    av_dict_set(&options, "timeout", "10000000", 0);    // microseconds without a word from the camera
    expected = "a camera that answers at this address";
  }
  const int code = avformat_open_input(&format, url.c_str(), form, &options);
  av_dict_free(&options);
  if (code < 0) {
    if (is_address(source)) problem = fmt::format("cannot be opened: {}", ffmpeg::reason(code));
    throw Error(source == "-" ? "standard input" : source, problem, expected);
  }
  return format;
}

/// A buffer for a picture that holds no other: what a decoder leaves out in it would otherwise show what was
/// in it before, which depends on how many pictures are decoded at once.
int empty_buffer(AVCodecContext* codec, AVFrame* frame, int flags) {
  const int code = avcodec_default_get_buffer2(codec, frame, flags);
  for (const AVBufferRef* buffer : frame->buf) {
    if (code >= 0 && buffer != nullptr) std::memset(buffer->data, 0, buffer->size);
  }
  return code;
}

}  // namespace

PacketDecoder::PacketDecoder(std::string source, int threads)
    : source_(std::move(source)), packet_(av_packet_alloc()), frame_(av_frame_alloc()) {
  std::error_code ignored;
  can_reopen_ = source_ != "-" && !is_address(source_) && std::filesystem::is_regular_file(source_, ignored);
  // Pictures wait for parts of those that they are predicted from. FFmpeg takes 16 threads at most.
  constexpr int kForEachCore = 4, kMost = 16;
  open(threads > 0 ? threads : std::min(kForEachCore * thread_count(), kMost));
}

void PacketDecoder::open(int threads) {
  codec_.reset();
  format_.reset(opened(source_));
  const auto require = [&](bool fine) {
    if (!fine) throw Error(source_, "is no video that FFmpeg can read", kRecordingForms);
  };
  require(avformat_find_stream_info(format_.get(), nullptr) >= 0);
  const AVCodec* codec = nullptr;
  const int index = av_find_best_stream(format_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
  require(index >= 0 && codec != nullptr);
  for (unsigned i = 0; i < format_->nb_streams; ++i) {
    if (static_cast<int>(i) != index) format_->streams[i]->discard = AVDISCARD_ALL;
  }
  stream_ = format_->streams[index];
  codec_.reset(avcodec_alloc_context3(codec));
  require(avcodec_parameters_to_context(codec_.get(), stream_->codecpar) >= 0);
  codec_->opaque = errors_.key();
  codec_->get_buffer2 = empty_buffer;
// Without it decoding threads wait for this one; later versions take it for granted.
#if LIBAVCODEC_VERSION_MAJOR < 60
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  codec_->thread_safe_callbacks = 1;
#pragma GCC diagnostic pop
#endif
  codec_->pkt_timebase = stream_->time_base;
  codec_->thread_count = threads;
  // Threads that share a picture do not delay it; those that take one each do, and are faster.
  if (is_address(source_)) codec_->thread_type = FF_THREAD_SLICE;
  require(avcodec_open2(codec_.get(), codec, nullptr) == 0);
  serial_ = threads == 1;
  drained_ = false;
  wrong_ = false;
  errors_seen_ = errors_.count();
  packet_s_.reset();
  given_ = 0;
  report_ = {};
}

double PacketDecoder::seconds(std::int64_t time) const {
  return static_cast<double>(time) * av_q2d(stream_->time_base);
}

void PacketDecoder::note_damage() {
  const bool any = wrong_ || errors_.count() != errors_seen_;
  errors_seen_ = errors_.count();
  wrong_ = false;
  if (!any) return;
  ++report_.damaged;
  if (!report_.first_damaged_s) report_.first_damaged_s = packet_s_;
}

void PacketDecoder::feed() {
  note_damage();  // all that the packet before could give has been taken
  while (av_read_frame(format_.get(), packet_.get()) >= 0) {
    const bool ours = packet_->stream_index == stream_->index;
    if (ours) {
      packet_s_ = packet_->pts == AV_NOPTS_VALUE ? std::nullopt : std::optional(seconds(packet_->pts));
      wrong_ = avcodec_send_packet(codec_.get(), packet_.get()) < 0;
    }
    av_packet_unref(packet_.get());
    if (ours) return;
  }
  avcodec_send_packet(codec_.get(), nullptr);
  drained_ = true;
}

const AVFrame* PacketDecoder::receive() {
  for (;;) {
    const int result = avcodec_receive_frame(codec_.get(), frame_.get());
    if (result == AVERROR_EOF || (result == AVERROR(EAGAIN) && drained_)) {
      note_damage();
      return nullptr;
    }
    if (result == 0) {
      wrong_ = wrong_ || frame_->decode_error_flags != 0 || (frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0;
      return frame_.get();
    }
    if (result == AVERROR(EAGAIN)) {
      feed();
    } else {
      wrong_ = true;
    }
    if (damaged() && !serial_ && can_reopen_) return nullptr;
  }
}

bool PacketDecoder::damaged() const {
  return wrong_ || errors_.count() != errors_seen_ || report_.damaged > 0;
}

void PacketDecoder::begin_again_serially() {
  const std::int64_t given = given_;
  const double end_s = report_.end_s;
  open(1);
  report_.end_s = end_s;  // of the frames that were given already
  while (given_ < given && receive() != nullptr) ++given_;
}

const AVFrame* PacketDecoder::next() {
  const AVFrame* frame = receive();
  if (damaged() && !serial_ && can_reopen_) {
    begin_again_serially();
    frame = receive();
  }
  if (frame == nullptr) {
    report_.ended = true;
    return nullptr;
  }
  ++given_;
  if (frame->best_effort_timestamp != AV_NOPTS_VALUE) {
    const std::int64_t end = frame->best_effort_timestamp + std::max<std::int64_t>(frame->pkt_duration, 0);
    report_.end_s = std::max(report_.end_s, seconds(end));
  }
  return frame;
}

bool PacketDecoder::seek(double time_s) {
  const auto time = static_cast<std::int64_t>(time_s / av_q2d(stream_->time_base));
  if (av_seek_frame(format_.get(), stream_->index, time, AVSEEK_FLAG_BACKWARD) < 0) return false;
  avcodec_flush_buffers(codec_.get());
  drained_ = false;
  return true;
}

}  // namespace vo
