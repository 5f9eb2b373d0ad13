#include "vo/base/large_memory.hpp"

#include <cstdint>
#include <new>
#include <sys/mman.h>

namespace vo {
namespace {

constexpr std::align_val_t kLargePage{2 << 20};

}  // namespace

void* allocate_large(std::size_t bytes) {
  void* memory = ::operator new(bytes, kLargePage);
#if defined(MADV_HUGEPAGE)
  madvise(memory, bytes, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_large(void* memory) {
  ::operator delete(memory, kLargePage);
}

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
