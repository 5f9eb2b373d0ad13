#pragma once

#include "io/ffmpeg.hpp"
#include "vo/image/grey_range.hpp"

#include <memory>
#include <optional>

#include <opencv2/core/mat.hpp>

struct SwsContext;

namespace vo {

/// How the pictures of a stream become upright with square pixels: scaled, then turned, then mirrored.
struct Upright {
  double pixel_aspect = 1;  ///< width of a pixel by its height
  int quarter_turns = 0;    ///< clockwise
  bool mirrored = false;    ///< left and right change places, after the turn
};

/// What the stream's side data and headers say [ISO/IEC 14496-12, 6.2.2: the matrix of a track].
Upright upright_of(const AVFormatContext& format, const AVStream& stream);

/// The picture with square pixels, turned and mirrored.
cv::Mat made_upright(const cv::Mat& stored, const Upright& how);

/// Grey and colour pictures of decoded frames.
class FramePictures {
 public:
  FramePictures();
  ~FramePictures();
  FramePictures(const FramePictures&) = delete;
  FramePictures& operator=(const FramePictures&) = delete;

  /// 8 bits, full range, as stored; empty if FFmpeg cannot convert the format. A deep frame's by `range`.
  cv::Mat grey(const AVFrame& frame, const GreyRange& range);
  /// BGR of another size; empty if FFmpeg cannot convert the format.
  cv::Mat colour(const AVFrame& frame, cv::Size size);

  /// The values of a frame of grey of more than 8 bits, as CV_16U; empty for any other.
  static cv::Mat deep_grey(const AVFrame& frame);

 private:
  cv::Mat scaled(SwsContext*& context, const AVFrame& frame, cv::Size size, int format);

  SwsContext* to_grey_ = nullptr;
  SwsContext* to_colour_ = nullptr;
};

}  // namespace vo
