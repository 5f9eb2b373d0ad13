#pragma once

#include <filesystem>
#include <memory>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Writes a video for people to look at: .mp4, H.264 by x264 where FFmpeg has it, which browsers play, else
/// MPEG-4. The file appears whole or not at all: `finish` gives it its name, and without it nothing is left
/// (`AtomicFile`).
///
/// The same pictures give the same bytes. A picture of 640x800 takes some 5 ms of one processor.
class VideoWriter {
 public:
  /// `size`: of all pictures, even numbers of pixels. `rate_hz`: pictures a second, up to 1000. Throws
  /// `vo::Error` naming the path if it cannot be written; `std::invalid_argument` for sizes that are odd or
  /// not positive, and other rates.
  VideoWriter(const std::filesystem::path& path, cv::Size size, double rate_hz);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// Appends a picture, BGR of 8 bits. Throws `std::invalid_argument` for another size or type, `vo::Error`
  /// naming the path and the reason if it cannot be written (disk full).
  void write(const cv::Mat& bgr);

  /// Completes the file. Throws as `write`; `std::invalid_argument` if nothing was written.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vo
