#include "vo/base/large_memory.hpp"

#include <cstdint>
#include <sys/mman.h>

namespace vo {

void populate([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_POPULATE_WRITE) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kLarge = 4 << 20, kPage = 4096;
  if (bytes < kLarge) return;
  const std::size_t to_page = kPage - reinterpret_cast<std::uintptr_t>(memory) % kPage;
  std::byte* pages = static_cast<std::byte*>(memory) + to_page;
  const std::size_t whole = (bytes - to_page) / kPage * kPage;
  madvise(pages, whole, MADV_HUGEPAGE);
  madvise(pages, whole, MADV_POPULATE_WRITE);
#endif
}

}  // namespace vo
