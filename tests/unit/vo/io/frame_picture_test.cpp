#include "io/frame_picture.hpp"

#include "io/ffmpeg.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace {

/// Gives pictures memory with bytes after it that nothing may change. OpenCV may keep some for itself, so
/// that it must stay.
class GuardedMemory : public cv::MatAllocator {
 public:
  cv::UMatData* allocate(int dims, const int* sizes, int type, void* data, std::size_t* step, cv::AccessFlag,
                         cv::UMatUsageFlags) const override {
    std::size_t total = CV_ELEM_SIZE(type);
    for (int i = dims - 1; i >= 0; --i) {
      if (step != nullptr) step[i] = total;
      total *= static_cast<std::size_t>(sizes[i]);
    }
    auto* memory = new cv::UMatData(this);
    memory->size = total;
    memory->data = memory->origdata =
        static_cast<std::uint8_t*>(data != nullptr ? data : std::malloc(total + kGuard));
    if (data != nullptr) memory->flags |= cv::UMatData::USER_ALLOCATED;
    if (data == nullptr) std::memset(memory->data + total, kMark, kGuard);
    return memory;
  }
  bool allocate(cv::UMatData*, cv::AccessFlag, cv::UMatUsageFlags) const override { return false; }
  void deallocate(cv::UMatData* memory) const override {
    if ((memory->flags & cv::UMatData::USER_ALLOCATED) == 0) {
      const std::uint8_t* const end = memory->data + memory->size;
      EXPECT_TRUE(std::all_of(end, end + kGuard, [](std::uint8_t byte) { return byte == kMark; }))
          << "written past the end of " << memory->size << " bytes";
      std::free(memory->data);
    }
    memory->origdata = nullptr;
    delete memory;
  }

 private:
  static constexpr std::size_t kGuard = 256;
  static constexpr std::uint8_t kMark = 0xA5;
};

/// A frame of one colour.
vo::ffmpeg::DecodedFrame frame_of(AVPixelFormat format, int width, int height) {
  vo::ffmpeg::DecodedFrame frame(av_frame_alloc());
  frame->format = format;
  frame->width = width;
  frame->height = height;
  EXPECT_EQ(av_frame_get_buffer(frame.get(), 0), 0);
  for (const AVBufferRef* buffer : frame->buf)
    if (buffer != nullptr) std::memset(buffer->data, 0x60, buffer->size);
  return frame;
}

TEST(FramePictures, StayWithinTheirMemoryForAnyWidth) {
  static GuardedMemory& guarded = *new GuardedMemory;
  cv::MatAllocator* const usual = cv::Mat::getDefaultAllocator();
  cv::Mat::setDefaultAllocator(&guarded);
  for (int width = 1; width <= 70; ++width) {
    vo::FramePictures pictures;
    for (const AVPixelFormat format : {AV_PIX_FMT_RGB24, AV_PIX_FMT_YUV444P10LE, AV_PIX_FMT_NV12}) {
      const auto frame = frame_of(format, width, 4);
      const cv::Mat grey = pictures.grey(*frame, {}), colour = pictures.colour(*frame, {width, 4});
      EXPECT_EQ(grey.size(), cv::Size(width, 4));
      EXPECT_EQ(colour.size(), cv::Size(width, 4));
      EXPECT_EQ(colour.type(), CV_8UC3);
      EXPECT_TRUE(grey.isContinuous() && colour.isContinuous());
    }
    // A grey of 0x60 stays that, whatever the width.
    const cv::Mat grey = pictures.grey(*frame_of(AV_PIX_FMT_RGB24, width, 4), {});
    EXPECT_LE(cv::norm(grey, cv::Mat(grey.size(), CV_8UC1, cv::Scalar(0x60)), cv::NORM_INF), 1) << width;
  }
  cv::Mat::setDefaultAllocator(usual);
}

}  // namespace
