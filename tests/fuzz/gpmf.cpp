// A piece of a GoPro's telemetry.
#include "io/gpmf.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::call_one(size, {[&] {
                          vo::gpmf_positions({data, size});
                        },
                        [&] {
                          vo::gpmf_accelerations({data, size});
                        }});
  return 0;
}
