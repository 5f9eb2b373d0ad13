#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace simulate {

/// An image with its mip pyramid, laid out for the rasteriser: 8-bit BGRA texels, each level half the last
/// down to 1x1, and one column and one row repeated at the far edges so that a bilinear read never needs a
/// clamp.
class Texture {
 public:
  /// Borrowed view of one level. `texels` has `height + 1` rows of `width + 1`.
  struct Level {
    const std::uint32_t* texels;
    int width;
    int height;
  };

  /// Builds the pyramid by area averaging. `bgra` is CV_8UC4, not empty; a texture is cut out where its alpha
  /// is below one half and opaque if alpha is 255 everywhere. Throws `std::invalid_argument` otherwise.
  explicit Texture(const cv::Mat& bgra);

  [[nodiscard]] int level_count() const { return static_cast<int>(layouts_.size()); }
  /// Level 0 is the image itself; `index` must be below `level_count()`.
  [[nodiscard]] Level level(int index) const {
    const Layout& layout = layouts_[static_cast<std::size_t>(index)];
    return {texels_.data() + layout.offset, layout.width, layout.height};
  }
  [[nodiscard]] bool opaque() const { return opaque_; }

 private:
  struct Layout {
    std::size_t offset;
    int width, height;
  };

  std::vector<std::uint32_t> texels_;
  std::vector<Layout> layouts_;
  bool opaque_ = true;
};

}  // namespace simulate
