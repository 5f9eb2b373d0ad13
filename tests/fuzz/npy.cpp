// An array of descriptors.
#include "fuzz.hpp"

#include <cstdlib>

#include <place/describe/npy.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::write("walk.npy", {data, size});
  fuzz::call(size, [&] {
    const place::FloatRows rows = place::read_npy(file);
    place::write_npy(file, rows);
    if (place::read_npy(file).values != rows.values) std::abort();
  });
  return 0;
}
