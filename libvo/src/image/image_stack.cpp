#include "vo/image/image_stack.hpp"

#include "vo/base/large_memory.hpp"

#include <algorithm>
#include <stdexcept>

namespace vo {

ImageStack make_image_stack(int width, int height, std::size_t count) {
  if (width < 0 || height < 0) throw std::invalid_argument("make_image_stack: negative size");
  ImageStack stack{.width = width, .height = height, .pixels = {}};
  resize_populated(stack.pixels, stack.image_size() * count);
  return stack;
}

ImageStack select(const ImageStack& stack, std::span<const std::size_t> indices) {
  ImageStack chosen = make_image_stack(stack.width, stack.height, indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= stack.size()) throw std::out_of_range("select: image index past the end of the stack");
    std::ranges::copy(stack[indices[i]], chosen[i].begin());
  }
  return chosen;
}

}  // namespace vo
