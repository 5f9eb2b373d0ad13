#pragma once

#include <cstddef>
#include <memory>

namespace vo {

/// Has the system bring the pages of memory just allocated, as few large ones as it can: a fault for each
/// page that is touched first costs many times as much. Nothing for less than a few megabytes, and where the
/// system knows no such call; nothing changes but the time. The memory's bytes stay undefined. O(bytes).
void populate(void* memory, std::size_t bytes);

/// An array of undefined values with its pages populated.
template <typename Value>
std::unique_ptr<Value[]> make_populated(std::size_t size) {
  auto values = std::make_unique_for_overwrite<Value[]>(size);
  populate(values.get(), size * sizeof(Value));
  return values;
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
