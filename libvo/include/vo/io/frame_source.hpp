#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// One picture of a walk.
struct Frame {
  std::int64_t index = 0;  ///< position in the source, from 0
  double time_s = 0;       ///< seconds since the first frame, strictly increasing
  cv::Mat image;           ///< 8 bit, upright; a video's is grey, others are grey or BGR as they come
  cv::Mat colour;          ///< of a video that was asked for it: BGR, small, upright; else empty
};

/// Settings of `open_frame_source`.
struct FrameSourceOptions {
  double image_rate_hz =
      30;  ///< frames per second of a folder of images, which carries no times (SSS 3.1: 25-30)
  int colour_width_px = 0;  ///< pixels, at most, of a video's pictures in colour; 0: none
};

/// Frames of a walk in order, once. A source is read from one thread.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame, or none at the end. Throws `vo::Error` naming the file that cannot be read.
  virtual std::optional<Frame> next() = 0;

  /// How many frames there should be, where the source says so.
  [[nodiscard]] virtual std::optional<std::int64_t> expected_frames() const { return std::nullopt; }

  /// What a user should know of the frames read so far; complete once `next` has returned none.
  [[nodiscard]] virtual std::vector<std::string> warnings() const { return {}; }
};

/// Opens a walk:
///  - a video file, any that FFmpeg reads. Times are the container's presentation times, so variable
///  frame
///    rate comes out right; frames without a usable time follow at the nominal rate, with a warning. Rotation
///    metadata is applied. A video that breaks off gives the frames it has, with a warning that says how
///    many;
///  - a folder of images (png jpg jpeg bmp tif tiff webp pgm ppm) in natural order (`2.png` before `10.png`),
///  all of one
///    size; other files are passed over;
///  - `camera:N`, the N-th camera; times are those of arrival.
/// Throws `vo::Error` if there is no such thing or it holds no frame.
std::unique_ptr<FrameSource> open_frame_source(const std::string& walk,
                                               const FrameSourceOptions& options = {});

/// True if `a` comes before `b` when runs of digits compare as numbers and all else as bytes. A strict weak
/// order in which only equal strings are equivalent.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace vo
