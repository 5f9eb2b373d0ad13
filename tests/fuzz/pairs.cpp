// A list of pairs of walks (sweep --list).
#include "fuzz.hpp"
#include "sweep_pairs.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::write("pairs.toml", {data, size}).string();
  fuzz::call(size, [&] { retrace::read_walk_pairs(file); });
  return 0;
}
