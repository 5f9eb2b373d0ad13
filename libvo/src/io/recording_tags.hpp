#pragma once

#include "io/ffmpeg.hpp"

#include <optional>

namespace vo {

/// What a video's container says of the recording.
struct RecordingTags {
  std::optional<double> created_utc_s;  ///< seconds since 1970
  bool created_at_end = false;          ///< or at the beginning
  /// Frames per second of the camera, where they play at another rate.
  std::optional<double> capture_rate_hz;
};

/// Reads them: `creation_time`, or Apple's `creationdate`, which has a time zone. Android writes its creation
/// time when the recording ends; a clock before the year 2000 was never set. `com.android.capture.fps` counts
/// where it is not within a half of `rate_hz`, at which the frames play: cameras do not keep their rate
/// exactly. Apple's `full-frame-rate-playback-intent` names no rate; where players are to slow down, the
/// times in the file are those of the recording.
RecordingTags recording_tags(const AVFormatContext& format, const AVStream& stream,
                             std::optional<double> rate_hz);

/// True time by playing time of a recording: 1/8 for 240 frames/s that play at 30. A ratio within 3 % of a
/// whole one is that.
double time_scale(double rate_hz, double capture_rate_hz);

}  // namespace vo
