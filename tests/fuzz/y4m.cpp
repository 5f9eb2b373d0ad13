// Y4M on standard input.
#include "fuzz.hpp"

#include <cstdlib>
#include <sys/mman.h>
#include <unistd.h>

#include <vo/io/frame_source.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int memory = ::memfd_create("walk.y4m", 0);
  const bool given = ::ftruncate(memory, 0) == 0 &&
                     ::pwrite(memory, data, size, 0) == static_cast<ssize_t>(size) &&
                     ::dup2(memory, STDIN_FILENO) == STDIN_FILENO && ::lseek(STDIN_FILENO, 0, SEEK_SET) == 0;
  if (!given) std::abort();
  constexpr std::size_t kDecoder = 96U << 20U;  // FFmpeg takes 50 MB at a time for a long frame
  fuzz::call(
      size,
      [] {
        constexpr int kFrames = 4;
        const auto source = vo::open_frame_source("-");
        for (int i = 0; i < kFrames; ++i) {
          if (!source->next()) break;
        }
        source->warnings();
      },
      kDecoder);
  return 0;
}
