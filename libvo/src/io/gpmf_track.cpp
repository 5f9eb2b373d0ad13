#include "io/gpmf_track.hpp"

#include "io/decoder_errors.hpp"
#include "io/ffmpeg.hpp"
#include "vo/base/error.hpp"

#include <algorithm>
#include <string>

namespace vo {
namespace {

ffmpeg::FormatContext opened(const std::string& path, const GpmfWanted& wanted) {
  AVFormatContext* format = nullptr;
  if (avformat_open_input(&format, ("file:" + path).c_str(), nullptr, nullptr) < 0)
    throw Error(path, "is no video that FFmpeg can read", wanted.expected);
  return ffmpeg::FormatContext(format);
}

std::span<AVStream* const> tracks_of(const AVFormatContext& format) {
  return {format.streams, format.nb_streams};
}

double track_start_s(const AVStream& stream) {
  return stream.start_time == AV_NOPTS_VALUE
             ? 0
             : static_cast<double>(stream.start_time) * av_q2d(stream.time_base);
}

}  // namespace

void visit_gpmf_pieces(const std::filesystem::path& path, const GpmfWanted& wanted,
                       const std::function<void(const GpmfPiece&)>& visit) {
  const std::string name = path.string();
  const DecoderErrors quiet;  // keeps FFmpeg from printing
  const ffmpeg::FormatContext format = opened(name, wanted);
  constexpr auto kTelemetry = MKTAG('g', 'p', 'm', 'd');
  const auto streams = tracks_of(*format);
  const auto found =
      std::ranges::find_if(streams, [&](const AVStream* s) { return s->codecpar->codec_tag == kTelemetry; });
  if (found == streams.end()) throw Error(name, wanted.missing, wanted.expected);
  const auto pictures = std::ranges::find_if(
      streams, [](const AVStream* s) { return s->codecpar->codec_type == AVMEDIA_TYPE_VIDEO; });
  const double first_frame_s = pictures == streams.end() ? 0 : track_start_s(**pictures);
  for (AVStream* stream : streams) stream->discard = stream == *found ? AVDISCARD_DEFAULT : AVDISCARD_ALL;

  constexpr double kUsualPiece_s = 1;
  const ffmpeg::Packet packet(av_packet_alloc());
  while (av_read_frame(format.get(), packet.get()) == 0) {
    if (packet->stream_index == (*found)->index && packet->pts != AV_NOPTS_VALUE) {
      const double tick_s = av_q2d((*found)->time_base);
      const double begin_s = static_cast<double>(packet->pts) * tick_s - first_frame_s;
      const double piece_s =
          packet->duration > 0 ? static_cast<double>(packet->duration) * tick_s : kUsualPiece_s;
      visit({.bytes = {packet->data, static_cast<std::size_t>(packet->size)},
             .begin_s = begin_s,
             .end_s = begin_s + piece_s});
    }
    av_packet_unref(packet.get());
  }
}

}  // namespace vo
