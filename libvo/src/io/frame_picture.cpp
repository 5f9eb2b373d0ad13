#include "io/frame_picture.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

extern "C" {
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

namespace vo {
namespace {

/// Whether luma goes from 0 to 255 rather than from 16 to 235 [ITU-R BT.601].
bool full_range(const AVFrame& frame) {
  switch (frame.format) {
    case AV_PIX_FMT_YUVJ420P:
    case AV_PIX_FMT_YUVJ422P:
    case AV_PIX_FMT_YUVJ444P:
    case AV_PIX_FMT_YUVJ440P:
    case AV_PIX_FMT_GRAY8:
      return true;
    default:
      return frame.color_range == AVCOL_RANGE_JPEG;
  }
}

/// The first plane, where it holds grey values of 8 bits; empty where it does not.
cv::Mat luma_plane(const AVFrame& frame) {
  const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  constexpr std::uint64_t kNoLuma = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BITSTREAM |
                                    AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_BAYER;
  if (format == nullptr || (format->flags & kNoLuma) != 0) return {};
  const AVComponentDescriptor& luma = format->comp[0];
  if (luma.plane != 0 || luma.depth != 8 || luma.step != 1 || luma.offset != 0 || luma.shift != 0) return {};
  return {frame.height, frame.width, CV_8UC1, frame.data[0], static_cast<std::size_t>(frame.linesize[0])};
}

}  // namespace

Upright upright_of(const AVFormatContext& format, const AVStream& stream) {
  Upright how;
  // av_guess_sample_aspect_ratio takes pointers to what it only reads.
  const AVRational aspect = av_guess_sample_aspect_ratio(const_cast<AVFormatContext*>(&format),
                                                         const_cast<AVStream*>(&stream), nullptr);
  // Within a hundredth encoders round; beyond four no camera goes, and headers are wrong.
  constexpr double kSquare = 0.01, kMost = 4;
  const double ratio = aspect.num > 0 && aspect.den > 0 ? av_q2d(aspect) : 1;
  if (std::abs(ratio - 1) > kSquare && ratio < kMost && ratio > 1 / kMost) how.pixel_aspect = ratio;

  const std::uint8_t* data = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
  if (data == nullptr) return how;
  std::array<std::int32_t, 9> matrix{};
  std::copy_n(reinterpret_cast<const std::int32_t*>(data), matrix.size(), matrix.begin());
  // Columns 0 and 1 give x and y on the display. A matrix that mirrors is a turn whose x is negated after it.
  const double determinant =
      static_cast<double>(matrix[0]) * matrix[4] - static_cast<double>(matrix[1]) * matrix[3];
  how.mirrored = determinant < 0;
  if (how.mirrored) av_display_matrix_flip(matrix.data(), 1, 0);
  const double angle_deg = av_display_rotation_get(matrix.data());  // counter-clockwise
  if (std::isfinite(angle_deg))
    how.quarter_turns = static_cast<int>((std::lround(-angle_deg / 90) % 4 + 4) % 4);
  return how;
}

cv::Mat made_upright(const cv::Mat& stored, const Upright& how) {
  if (stored.empty()) return stored;
  cv::Mat picture = stored;
  if (how.pixel_aspect > 1) {
    cv::resize(picture, picture, {static_cast<int>(std::lround(stored.cols * how.pixel_aspect)), stored.rows},
               0, 0, cv::INTER_LINEAR);
  } else if (how.pixel_aspect < 1) {
    cv::resize(picture, picture, {stored.cols, static_cast<int>(std::lround(stored.rows / how.pixel_aspect))},
               0, 0, cv::INTER_LINEAR);
  }
  if (how.quarter_turns > 0) {
    constexpr cv::RotateFlags kTurns[] = {cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180,
                                          cv::ROTATE_90_COUNTERCLOCKWISE};
    cv::Mat turned;
    cv::rotate(picture, turned, kTurns[how.quarter_turns - 1]);
    picture = turned;
  }
  if (how.mirrored) {
    cv::Mat flipped;
    cv::flip(picture, flipped, 1);
    picture = flipped;
  }
  return picture;
}

FramePictures::FramePictures() = default;

FramePictures::~FramePictures() {
  sws_freeContext(to_grey_);
  sws_freeContext(to_colour_);
}

cv::Mat FramePictures::scaled(SwsContext*& context, const AVFrame& frame, cv::Size size, int format) {
  context = sws_getCachedContext(context, frame.width, frame.height, static_cast<AVPixelFormat>(frame.format),
                                 size.width, size.height, static_cast<AVPixelFormat>(format),
                                 SWS_AREA | SWS_ACCURATE_RND, nullptr, nullptr, nullptr);
  if (context == nullptr) return {};
  sws_setColorspaceDetails(context, sws_getCoefficients(frame.colorspace), full_range(frame) ? 1 : 0,
                           sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, 1 << 16, 1 << 16);
  // swscale fills lines by whole vectors and writes past the end of a picture of any other width.
  constexpr int kVector = 64;  // bytes, the longest there are
  const int type = format == AV_PIX_FMT_GRAY8 ? CV_8UC1 : CV_8UC3;
  const int line = static_cast<int>(size.width * CV_ELEM_SIZE(type));
  const cv::Mat room(size.height, (line / kVector + 2) * kVector, CV_8UC1);
  std::uint8_t* const planes[] = {room.data};
  const int strides[] = {static_cast<int>(room.step)};
  sws_scale(context, frame.data, frame.linesize, 0, frame.height, planes, strides);
  return cv::Mat(size, type, room.data, room.step).clone();
}

cv::Mat FramePictures::deep_grey(const AVFrame& frame) {
  const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  constexpr std::uint64_t kOther = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_FLOAT |
                                   AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_BAYER;
  if (format == nullptr || format->nb_components != 1 || format->comp[0].depth <= 8 ||
      (format->flags & kOther) != 0)
    return {};
  const cv::Mat stored(frame.height, frame.width, CV_16UC1, frame.data[0],
                       static_cast<std::size_t>(frame.linesize[0]));
  if ((format->flags & AV_PIX_FMT_FLAG_BE) == 0) return stored;
  cv::Mat swapped = stored.clone();  // PNG's bytes are in the other order
  for (auto value = swapped.begin<std::uint16_t>(); value != swapped.end<std::uint16_t>(); ++value)
    *value = static_cast<std::uint16_t>(*value << 8 | *value >> 8);
  return swapped;
}

cv::Mat FramePictures::grey(const AVFrame& frame, const GreyRange& range) {
  const cv::Mat deep = deep_grey(frame);
  if (!deep.empty()) return stretched(deep, range);
  const cv::Mat luma = luma_plane(frame);
  if (luma.empty()) return scaled(to_grey_, frame, {frame.width, frame.height}, AV_PIX_FMT_GRAY8);
  cv::Mat image;
  if (full_range(frame)) {
    luma.copyTo(image);
  } else {
    luma.convertTo(image, CV_8U, 255.0 / 219, -16 * 255.0 / 219);
  }
  return image;
}

cv::Mat FramePictures::colour(const AVFrame& frame, cv::Size size) {
  return scaled(to_colour_, frame, size, AV_PIX_FMT_BGR24);
}

}  // namespace vo
