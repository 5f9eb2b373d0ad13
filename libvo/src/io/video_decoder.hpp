#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Decodes the video stream of a file by FFmpeg's own libraries. OpenCV's reader converts every frame to
/// colour, and what follows wants grey: the luma plane, which is there already.
class VideoDecoder {
 public:
  struct Picture {
    std::optional<double> time_s;  ///< presentation time, where the container has one
    cv::Mat grey;                  ///< 8 bit, full range, upright
    cv::Mat colour;                ///< BGR, upright, at most the width asked for; empty if none was
  };

  /// Opens `path`. Throws `vo::Error` if FFmpeg finds no video in it.
  explicit VideoDecoder(const std::string& path);
  ~VideoDecoder();

  /// The next picture, with one in colour of at most `colour_width_px` columns (0: without); none at the end
  /// or where the file breaks off. Packets that cannot be decoded are passed over. Throws `vo::Error` if the
  /// pictures change their size.
  std::optional<Picture> next(int colour_width_px);

  [[nodiscard]] std::optional<double> rate_hz() const;                ///< nominal frames per second
  [[nodiscard]] std::optional<std::int64_t> expected_frames() const;  ///< counted, or duration by rate

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vo
