#pragma once

#include <cstddef>
#include <unistd.h>

namespace place {

/// Bytes of a core's second-level cache, or the usual 512 KB if the system does not report it.
inline std::size_t second_level_cache() {
  static const std::size_t size = [] {
    constexpr long kUsual = 1L << 19U;
    const long bytes = sysconf(_SC_LEVEL2_CACHE_SIZE);
    return static_cast<std::size_t>(bytes > 0 ? bytes : kUsual);
  }();
  return size;
}

}  // namespace place
