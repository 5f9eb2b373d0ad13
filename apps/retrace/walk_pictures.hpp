#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include <place/route/route.hpp>
#include <vo/io/frame_source.hpp>

namespace retrace {

/// One picture of a walk.
struct WalkPicture {
  cv::Mat image;      ///< BGR, upright
  double time_s = 0;  ///< since the walk's first frame
};

/// Pictures of a walk by the numbers of its frames.
class WalkPictures {
 public:
  virtual ~WalkPictures() = default;

  /// Throws `vo::Error` if the recording cannot be read or has no such frame.
  virtual WalkPicture at(std::int64_t frame) = 0;
};

/// The files of a walk, in order.
struct Recording {
  std::vector<std::string> files;
  vo::FrameSourceOptions options;
  std::int64_t frames = 0;  ///< that it must have; 0: any number
};

/// Pictures of a recording, at most `width_px` wide. Those asked for should not go back far: the last 64 are
/// kept, and further back it is read from its start again. Throws `vo::Error` if it cannot be opened, or is
/// not as long as expected, to a fiftieth where its file says how long it is, and in the end exactly.
std::unique_ptr<WalkPictures> recorded_pictures(Recording recording, int width_px);

/// The previews of a traverse's keyframes: each frame has the nearest one's. Null if there are none.
std::unique_ptr<WalkPictures> preview_pictures(const place::Traverse& traverse);

}  // namespace retrace
