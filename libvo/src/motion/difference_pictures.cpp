#include "vo/motion/difference_pictures.hpp"

#include "vo/base/parallel.hpp"

#include <cstdint>
#include <cstdlib>
#include <stdexcept>

namespace vo {
namespace {

DifferencePicture picture_over(const ImageStack& images, const std::vector<Comparison>& comparisons,
                               const std::vector<bool>& excluded) {
  DifferencePicture picture{.width = images.width, .height = images.height, .mean = {}};
  std::vector<std::uint64_t> sums(images.image_size(), 0);
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    if (!comparisons[i].made() || (!excluded.empty() && excluded[i])) continue;
    const std::span<const std::uint8_t> a = images[i], b = images[i + comparisons[i].frames];
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] += static_cast<std::uint64_t>(std::abs(int{a[k]} - int{b[k]}));
    picture.seconds += static_cast<double>(comparisons[i].seconds);
    ++picture.pairs;
  }
  const double pairs = picture.pairs > 0 ? static_cast<double>(picture.pairs) : 1;
  picture.seconds /= pairs;
  for (const std::uint64_t sum : sums) picture.mean.push_back(static_cast<double>(sum) / pairs);
  return picture;
}

}  // namespace

std::vector<DifferencePicture> difference_pictures(const ImageStack& images, const AlignmentErrors& errors,
                                                   std::span<const std::size_t> spans,
                                                   const std::vector<bool>& excluded) {
  if (images.size() != errors.frames())
    throw std::invalid_argument("difference_pictures: one image for each frame expected");
  if (!excluded.empty() && excluded.size() != images.size())
    throw std::invalid_argument("difference_pictures: one flag for each frame expected");
  for (const std::size_t span : spans) {
    if (span < 1 || span > errors.spans())
      throw std::invalid_argument("difference_pictures: spans that were compared expected");
  }
  std::vector<DifferencePicture> pictures(spans.size());
  parallel_for(spans.size(), [&](std::size_t s) {
    pictures[s] = picture_over(images, errors.by_span[spans[s] - 1], excluded);
  });
  return pictures;
}

}  // namespace vo
