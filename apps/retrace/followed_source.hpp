#pragma once

#include "interruption.hpp"
#include "newest_frame.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vo/io/frame_source.hpp>

namespace retrace {

/// The frames of a walk as `retrace follow` takes them: of a camera or a stream the newest one each time, of
/// anything else every one. They end with the source, with Ctrl-C, when reading fails, and when a camera
/// sends no picture for `patience_s`. The last two are said at the very end (`check_end`), since what was
/// seen until then is kept.
class FollowedSource {
 public:
  /// `walk`: what `source` reads, for messages and to know a live one.
  FollowedSource(std::string walk, std::unique_ptr<vo::FrameSource> source, double patience_s = 10);

  /// The next frame, waiting for it; none at the end.
  std::optional<vo::Frame> next();

  /// Throws `vo::Error` naming the walk if it ended by a failure. Called when its results are written.
  void check_end() const;

  /// Frames that came while their reader was busy.
  [[nodiscard]] std::int64_t skipped() const { return skipped_; }
  /// What a user should know of the recording, and how many frames were skipped.
  [[nodiscard]] std::vector<std::string> warnings() const;
  /// See `vo::FrameSource`; none of a live source.
  [[nodiscard]] std::optional<double> start_utc_s() const;

 private:
  std::string walk_;
  double patience_s_;
  std::unique_ptr<vo::FrameSource> source_;  // unless it is live
  std::optional<NewestFrame> newest_;        // if it is
  std::int64_t skipped_ = 0;
  std::string trouble_;     // why reading failed
  bool broke_off_ = false;  // a live source ended, without a wait
  EndableReading endable_;
};

}  // namespace retrace
