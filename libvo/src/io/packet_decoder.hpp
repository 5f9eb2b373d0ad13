#pragma once

#include "io/decoder_errors.hpp"
#include "io/ffmpeg.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace vo {

/// What a decoder met on its way.
struct DecodingReport {
  std::int64_t damaged = 0;               ///< packets at which the decoder found something wrong
  std::optional<double> first_damaged_s;  ///< when the first of them is, in the stream's own time
  double end_s = 0;                       ///< when the last picture ends, in the stream's own time
  bool ended = false;                     ///< there are no more pictures
};

/// The decoded frames of the video stream of a file, a network address or standard input, in order of
/// presentation.
///
/// A decoder of many threads hides damage behind whatever its neighbours have ready, so that what it shows
/// differs from run to run. A file is therefore decoded by many threads up to the first damage that the
/// decoder reports, and from there by one, which opens the file again and passes over what was given out
/// already: the same pictures and the same count in every run and for any number of threads.
class PacketDecoder {
 public:
  /// `source`: a path, an rtsp:// address, or `-` for Y4M on standard input. `threads`: 0 for a few for
  /// each of `thread_count`. Throws `vo::Error` if FFmpeg finds no video.
  explicit PacketDecoder(std::string source, int threads = 0);

  /// The next frame, which lives until the next call; null at the end.
  const AVFrame* next();

  /// Goes to the last key frame before a time of the stream; false if the source cannot.
  bool seek(double time_s);

  [[nodiscard]] const AVFormatContext& format() const { return *format_; }
  [[nodiscard]] const AVStream& stream() const { return *stream_; }
  [[nodiscard]] const DecodingReport& report() const { return report_; }

  /// Seconds of a time in the stream's units.
  [[nodiscard]] double seconds(std::int64_t time) const;

 private:
  void open(int threads);
  void feed();
  void note_damage();
  [[nodiscard]] bool damaged() const;
  void begin_again_serially();
  const AVFrame* receive();

  std::string source_;
  ffmpeg::FormatContext format_;
  const AVStream* stream_ = nullptr;
  DecoderErrors errors_;  ///< outlives the codec
  ffmpeg::CodecContext codec_;
  ffmpeg::Packet packet_;
  ffmpeg::DecodedFrame frame_;
  bool drained_ = false;            ///< there are no more packets
  bool serial_ = false;             ///< one thread decodes
  bool can_reopen_ = false;         ///< the source is a file
  int errors_seen_ = 0;             ///< of `errors_`, at the packet before
  bool wrong_ = false;              ///< the decoder gave an error or a damaged picture for this packet
  std::optional<double> packet_s_;  ///< when this packet is presented
  std::int64_t given_ = 0;          ///< frames given out
  DecodingReport report_;
};

}  // namespace vo
