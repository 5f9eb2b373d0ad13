#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace vo {

/// Asks the system to map the pages of memory just allocated, in large pages if it can, because a page fault
/// at the first touch of each small page costs many times as much. Does nothing for less than a few megabytes
/// or where the system has no such call; only the time changes. The bytes stay undefined. O(bytes).
void populate(void* memory, std::size_t bytes);

/// Memory aligned to a large page, for which large pages are asked. They are mapped when first touched, so
/// several threads can do that at once. Bytes are undefined. Throws `std::bad_alloc`.
void* allocate_large(std::size_t bytes);
void free_large(void* memory);

struct FreeLarge {
  void operator()(void* memory) const { free_large(memory); }
};
template <typename Value>
using LargeArray = std::unique_ptr<Value[], FreeLarge>;

/// An array of undefined values in such memory.
template <typename Value>
requires std::is_trivial_v<Value> LargeArray<Value> make_large_array(std::size_t size) {
  return LargeArray<Value>(static_cast<Value*>(allocate_large(size * sizeof(Value))));
}

/// `vector.resize(size)` with its pages populated, for vectors of many megabytes.
template <typename Vector>
void resize_populated(Vector& vector, std::size_t size) {
  if (size > vector.capacity()) {
    vector.reserve(size);
    const std::size_t used = vector.size();
    populate(vector.data() + used, (size - used) * sizeof(*vector.data()));
  }
  vector.resize(size);
}

}  // namespace vo
