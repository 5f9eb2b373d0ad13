#include "vo/image/image_stack.hpp"

#include <algorithm>
#include <stdexcept>
#include <sys/mman.h>

namespace vo {
namespace {

/// Has the system bring all pages of a large block at once: a fault for each, when it is touched, costs
/// several times as much. Where the system knows no such call, pages come as ever.
void populate([[maybe_unused]] std::uint8_t* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::size_t kLarge = 1 << 20, kPage = 4096;
  if (bytes < kLarge) return;
  const std::size_t to_page = kPage - reinterpret_cast<std::uintptr_t>(memory) % kPage;
  madvise(memory + to_page, (bytes - to_page) / kPage * kPage, MADV_POPULATE_WRITE);
#endif
}

}  // namespace

ImageStack make_image_stack(int width, int height, std::size_t count) {
  if (width < 0 || height < 0) throw std::invalid_argument("make_image_stack: negative size");
  ImageStack stack{.width = width, .height = height, .pixels = {}};
  const std::size_t bytes = stack.image_size() * count;
  stack.pixels.reserve(bytes);
  populate(stack.pixels.data(), bytes);
  stack.pixels.resize(bytes);
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
