#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <place/describe/descriptor.hpp>
#include <vo/base/rng.hpp>
#include <vo/image/thumbnail.hpp>

/// Pictures of places that look unlike each other, for tests of descriptors.
namespace test_support {

/// How a place is seen.
struct View {
  double gain = 1;    ///< grey levels are multiplied by this
  double noise = 0;   ///< grey levels, deviation of each pixel
  int turned_px = 0;  ///< how far to the right the camera looks, of a picture 640 wide
};

/// A place: rectangles of random sizes and greys on a wide wall, seen 640x360.
inline cv::Mat view_of(std::size_t place, const View& view) {
  vo::Rng rng(1000 + place);
  constexpr int kWidth = 640, kHeight = 360, kBeyond = 200;
  cv::Mat wall(kHeight, kWidth + 2 * kBeyond, CV_8U, cv::Scalar(128));
  for (int i = 0; i < 150; ++i) {
    const auto pick = [&](int count) {
      return static_cast<int>(rng.index(static_cast<std::uint64_t>(count)));
    };
    const cv::Rect box(pick(wall.cols) - 40, pick(kHeight) - 30, 20 + pick(100), 20 + pick(100));
    cv::rectangle(wall, box, cv::Scalar(pick(256)), cv::FILLED);
  }
  cv::Mat seen = wall.colRange(kBeyond + view.turned_px, kBeyond + view.turned_px + kWidth).clone();
  vo::Rng noise(7 * place + 1);
  for (int y = 0; y < seen.rows; ++y)
    for (int x = 0; x < seen.cols; ++x)
      seen.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(
          view.gain * seen.at<std::uint8_t>(y, x) + (view.noise > 0 ? view.noise * noise.normal() : 0));
  return seen;
}

inline std::vector<place::Bytes> records_of(const place::Descriptor& descriptor, std::size_t places,
                                            const View& view) {
  std::vector<place::Bytes> records;
  for (std::size_t i = 0; i < places; ++i) {
    vo::Frame frame;
    frame.image = view_of(i, view);
    records.push_back(descriptor.record(frame));
  }
  return records;
}

/// Keyframes of a walk from place to place, one a second.
inline place::KeyframeRecords keyframes_of(const place::Descriptor& descriptor, std::size_t places,
                                           const View& view) {
  place::KeyframeRecords keyframes;
  const vo::ThumbnailOptions size;
  keyframes.thumbnails = vo::make_image_stack(size.width, size.height, places);
  for (std::size_t i = 0; i < places; ++i) {
    keyframes.frames.push_back(25 * i);
    keyframes.time_s.push_back(static_cast<double>(i));
    vo::make_thumbnail(view_of(i, view), size, keyframes.thumbnails[i]);
  }
  keyframes.records = records_of(descriptor, places, view);
  return keyframes;
}

}  // namespace test_support
