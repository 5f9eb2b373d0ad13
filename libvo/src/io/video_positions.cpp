#include "vo/io/video_positions.hpp"

#include "io/decoder_errors.hpp"
#include "io/ffmpeg.hpp"
#include "io/gpmf.hpp"
#include "vo/base/error.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include <fmt/format.h>

namespace vo {
namespace {

constexpr const char* kForm = "a GoPro's .mp4 with the GPS switched on, or a GPX or CSV file";

ffmpeg::FormatContext opened(const std::string& path) {
  AVFormatContext* format = nullptr;
  if (avformat_open_input(&format, ("file:" + path).c_str(), nullptr, nullptr) < 0)
    throw Error(path, "is no video that FFmpeg can read", kForm);
  return ffmpeg::FormatContext(format);
}

std::span<AVStream* const> streams_of(const AVFormatContext& format) {
  return {format.streams, format.nb_streams};
}

double start_s(const AVStream& stream) {
  return stream.start_time == AV_NOPTS_VALUE
             ? 0
             : static_cast<double>(stream.start_time) * av_q2d(stream.time_base);
}

/// The positions of a piece, evenly over [begin_s, end_s).
void spread(std::span<const GpmfPosition> piece, double begin_s, double end_s, VideoPositions& all) {
  const double interval_s = (end_s - begin_s) / static_cast<double>(piece.size());
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (!piece[i].fix) {
      ++all.without_fix;
      continue;
    }
    all.positions.push_back({.time_s = begin_s + interval_s * static_cast<double>(i),
                             .latitude_deg = piece[i].latitude_deg,
                             .longitude_deg = piece[i].longitude_deg});
  }
}

}  // namespace

VideoPositions read_video_positions(const std::filesystem::path& path) {
  const std::string name = path.string();
  const DecoderErrors quiet;  // keeps FFmpeg from printing
  const ffmpeg::FormatContext format = opened(name);
  constexpr auto kTelemetry = MKTAG('g', 'p', 'm', 'd');
  const auto streams = streams_of(*format);
  const auto found =
      std::ranges::find_if(streams, [&](const AVStream* s) { return s->codecpar->codec_tag == kTelemetry; });
  if (found == streams.end()) throw Error(name, "has no GPS track", kForm);
  const auto pictures = std::ranges::find_if(
      streams, [](const AVStream* s) { return s->codecpar->codec_type == AVMEDIA_TYPE_VIDEO; });
  const double first_frame_s = pictures == streams.end() ? 0 : start_s(**pictures);
  for (AVStream* stream : streams) stream->discard = stream == *found ? AVDISCARD_DEFAULT : AVDISCARD_ALL;

  VideoPositions all;
  constexpr double kUsualPiece_s = 1;
  const ffmpeg::Packet packet(av_packet_alloc());
  while (av_read_frame(format.get(), packet.get()) == 0) {
    if (packet->stream_index == (*found)->index && packet->pts != AV_NOPTS_VALUE) {
      const double tick_s = av_q2d((*found)->time_base);
      const double begin_s = static_cast<double>(packet->pts) * tick_s - first_frame_s;
      const double piece_s =
          packet->duration > 0 ? static_cast<double>(packet->duration) * tick_s : kUsualPiece_s;
      const auto piece = gpmf_positions({packet->data, static_cast<std::size_t>(packet->size)});
      if (!piece) ++all.damaged;
      if (piece && !piece->empty()) spread(*piece, begin_s, begin_s + piece_s, all);
    }
    av_packet_unref(packet.get());
  }
  return all;
}

}  // namespace vo
