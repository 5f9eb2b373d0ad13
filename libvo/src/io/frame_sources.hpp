#pragma once

#include "vo/io/frame_source.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace vo {

/// A source of which pictures can be looked at before its first frame is read.
class SampledSource : public FrameSource {
 public:
  /// Up to so many pictures from all over the walk, grey, 8 bits, upright; none where that cannot be done.
  [[nodiscard]] virtual std::vector<cv::Mat> sample(std::size_t count) const = 0;
};

/// The kinds of `open_frame_source`, before crop and mask.
std::unique_ptr<SampledSource> open_video(const std::string& source, const FrameSourceOptions& options);
std::unique_ptr<SampledSource> open_folder(const std::string& folder, const FrameSourceOptions& options);
std::unique_ptr<SampledSource> open_camera(int number);

/// The source's pictures, cropped and masked as the options say, or between their black bars.
std::unique_ptr<FrameSource> prepared(std::unique_ptr<SampledSource> source, const std::string& name,
                                      const FrameSourceOptions& options);

/// Several walks as one.
std::unique_ptr<FrameSource> chained(std::span<const std::string> walks, const FrameSourceOptions& options);

/// Pictures looked at beforehand.
inline constexpr std::size_t kSamples = 32;

}  // namespace vo
