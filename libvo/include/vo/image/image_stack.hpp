#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

namespace vo {

/// Memory of a vector from a cache line on, so that no load of a register's width crosses into the next.
template <typename T>
struct CacheAligned {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};

  CacheAligned() = default;
  template <typename U>
  CacheAligned(const CacheAligned<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kLine)); }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, kLine); }
  bool operator==(const CacheAligned&) const { return true; }
};

/// Images that are only looked at, where they are: an `ImageStack`, or other memory of that form.
struct ImageStackView {
  int width = 0;
  int height = 0;
  std::span<const std::uint8_t> pixels;

  [[nodiscard]] std::size_t image_size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] std::size_t size() const { return image_size() == 0 ? 0 : pixels.size() / image_size(); }
  [[nodiscard]] std::span<const std::uint8_t> operator[](std::size_t i) const {
    return pixels.subspan(i * image_size(), image_size());
  }
};

/// Small grey images of one size, one after another in memory, each row-major: the thumbnails of a walk, or
/// the descriptors made of them.
struct ImageStack {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t, CacheAligned<std::uint8_t>> pixels;

  [[nodiscard]] std::size_t image_size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] std::size_t size() const { return image_size() == 0 ? 0 : pixels.size() / image_size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] std::span<const std::uint8_t> operator[](std::size_t i) const {
    return std::span(pixels).subspan(i * image_size(), image_size());
  }
  [[nodiscard]] std::span<std::uint8_t> operator[](std::size_t i) {
    return std::span(pixels).subspan(i * image_size(), image_size());
  }
  operator ImageStackView() const { return {width, height, pixels}; }
};

/// An empty stack with room for `count` images of the given size, all zero.
ImageStack make_image_stack(int width, int height, std::size_t count);

/// The images at `indices`, in that order. Throws `std::out_of_range` for an index past the end.
ImageStack select(const ImageStack& stack, std::span<const std::size_t> indices);

}  // namespace vo
