#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace vo {

/// Has the system bring the pages of memory just allocated, as few large ones as it can: a fault for each
/// page that is touched first costs many times as much. Nothing for less than a few megabytes, and where the
/// system knows no such call; nothing changes but the time. The memory's bytes stay undefined. O(bytes).
void populate(void* memory, std::size_t bytes);

/// Memory that begins at a large page and asks for large ones, which come as they are touched: by several
/// threads at once, if those do. Bytes are undefined. Throws `std::bad_alloc`.
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
