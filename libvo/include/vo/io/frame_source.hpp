#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// One picture of a walk.
struct Frame {
  std::int64_t index = 0;  ///< position among the frames of the source, from 0
  double time_s = 0;       ///< seconds since the first frame, strictly increasing
  cv::Mat image;           ///< 8 bit, upright; a video's is grey, others are grey or BGR as they come
  cv::Mat colour;          ///< of a video that was asked for it: BGR, small, upright; else empty
};

inline constexpr double kImageRate_hz = 30;  ///< of a folder of images (SSS 3.1: 25-30)

/// Settings of `open_frame_source`.
struct FrameSourceOptions {
  /// Frames per second, instead of the times that a recording has, for one whose times are not those of the
  /// walk (slow motion, time lapse) and whose file does not say so. None: a folder of images, which carries
  /// no times, has `kImageRate_hz`. Refused for a camera, whose pictures come when they come.
  std::optional<double> frame_rate_hz;
  /// Times of a folder's pictures from their EXIF data (`picture_times_s`) instead of a rate. Refused with
  /// `frame_rate_hz`, and for all but folders.
  bool exif_times = false;
  int colour_width_px = 0;  ///< pixels, at most, of a video's pictures in colour; 0: none
  /// The part of every picture, upright and with square pixels, that is read. None: black bars are found and
  /// left out, where the recording can be looked at beforehand (`look_ahead`).
  std::optional<cv::Rect> crop;
  std::string mask;  ///< a picture of a recording's shape, black where `vo::PictureMask` fills; empty: none
  bool look_ahead = true;  ///< pictures all over a file may be looked at before the first is given out
};

/// Frames of a walk in order, once. A source is read from one thread.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame, or none at the end. Throws `vo::Error` naming the file that cannot be read.
  virtual std::optional<Frame> next() = 0;

  /// How many frames there should be, where the source says so.
  [[nodiscard]] virtual std::optional<std::int64_t> expected_frames() const { return std::nullopt; }

  /// Seconds since 1970 (UTC) at the first frame, where the source says so.
  [[nodiscard]] virtual std::optional<double> start_utc_s() const { return std::nullopt; }

  /// What a user should know of the frames read so far; complete once `next` has returned none.
  [[nodiscard]] virtual std::vector<std::string> warnings() const { return {}; }
};

/// True for a walk that goes on until it is ended: a camera, an address, standard input.
bool is_live(std::string_view walk);

/// Opens a walk:
///  - a video file, any that FFmpeg reads. Times are the container's presentation times, so a variable
///    frame rate comes out right; frames without a usable time follow at the nominal rate, with a warning.
///    Where a tag says that it was recorded at another rate than it plays at (Android's slow motion and time
///    lapse), times are those of the recording. The display matrix is applied, mirrored or not, and pixels
///    are made square. Frames that the decoder says are damaged are counted in a warning, the same in every
///    run; a video that breaks off gives the frames it has, with a warning;
///  - a folder of images (png jpg jpeg bmp tif tiff webp pgm ppm) in natural order (`2.png` before
///    `10.png`), all of one size; other files and hidden ones are skipped. Images that cannot be read are
///    left out with a warning, as if the camera had lost them: their time passes, and later images are
///    numbered without them. More than a tenth is refused;
///  - `camera:N`, the N-th camera; times are those of arrival;
///  - an `rtsp://` address, over TCP; times are the camera's;
///  - `-`, Y4M on standard input; times are by its frame rate.
/// Pictures of more than 8 bits a value are stretched to 8 by the range that the walk uses (`vo::range_of`,
/// of up to 32 pictures; without `look_ahead`, of the first). Throws `vo::Error` if there is no such thing,
/// it holds no frame, crop or mask do not fit it; `std::invalid_argument` for options out of range.
std::unique_ptr<FrameSource> open_frame_source(const std::string& walk,
                                               const FrameSourceOptions& options = {});

/// Opens video files and folders of images, in order, as one walk (the chapters that cameras cut long
/// recordings into). Frame numbers and times go on; between two files lies what their creation times say, to
/// a second, where that is from 0 to 12 hours; files of one creation time, and those that end within 1.5 s of
/// the next one's, follow at once; others follow `kUnknownPause_s` later, with a warning. Throws as for one;
/// `vo::Error` for pictures of another size, and for cameras, addresses and standard input among several.
std::unique_ptr<FrameSource> open_frame_source(std::span<const std::string> walks,
                                               const FrameSourceOptions& options = {});
inline constexpr double kUnknownPause_s = 1;

/// The images of a folder in natural order, hidden files left out. Throws `vo::Error` if there is none.
std::vector<std::string> image_files(const std::string& folder);

/// True if `a` comes before `b` when runs of digits compare as numbers and all else as bytes. A strict weak
/// order in which only equal strings are equivalent.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace vo
